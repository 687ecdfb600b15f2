import { defineConfig } from "vitest/config";

// What is under assets/ has its hash in its name, so that a browser may keep it for good (server/ops/page.cpp).
export default defineConfig({
  base: "./",
  build: {
    target: "es2022",
    modulePreload: false,
    emptyOutDir: true,
    chunkSizeWarningLimit: 1000,
    rollupOptions: { output: { entryFileNames: "assets/page-[hash].js", assetFileNames: "assets/page-[hash][extname]", inlineDynamicImports: true } },
  },
  worker: { format: "es", rollupOptions: { output: { entryFileNames: "assets/worker-[hash].js" } } },
  test: { include: ["test/*.test.ts"] },
  server: { proxy: { "/v1": "http://127.0.0.1:8080", "/openapi.json": "http://127.0.0.1:8080", "/samples": "http://127.0.0.1:8080" } },
});
