import { defineConfig } from "vitest/config";

// Names without hashes: CMake lists the files that go into vsplitd.
export default defineConfig({
  base: "./",
  build: {
    target: "es2022",
    modulePreload: false,
    emptyOutDir: true,
    chunkSizeWarningLimit: 1000,
    rollupOptions: { output: { entryFileNames: "page.js", assetFileNames: "page[extname]", inlineDynamicImports: true } },
  },
  worker: { format: "es", rollupOptions: { output: { entryFileNames: "worker.js" } } },
  test: { include: ["test/*.test.ts"] },
  server: { proxy: { "/v1": "http://127.0.0.1:8080", "/openapi.json": "http://127.0.0.1:8080", "/samples": "http://127.0.0.1:8080" } },
});
