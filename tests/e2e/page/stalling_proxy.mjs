// A server in front of another one. While `stall` is set, answers of methods stop after so many bytes, and never go on.
import { createServer, request } from "node:http";

const enough = 64 * 1024;

export async function startProxy(address) {
  const { hostname, port } = new URL(address);
  const proxy = { stall: false, address: "", stop: () => {} };
  const server = createServer((asked, answer) => {
    const stalled = proxy.stall && asked.url.endsWith(":improve");
    const passed = request({ hostname, port, method: asked.method, path: asked.url, headers: asked.headers }, (got) => {
      answer.writeHead(got.statusCode, got.headers);
      let sent = 0;
      got.on("data", (bytes) => {
        answer.write(bytes);
        sent += bytes.length;
        if (stalled && sent >= enough) got.pause();
      });
      got.on("end", () => answer.end());
      got.on("error", () => answer.destroy());
    });
    passed.on("error", () => answer.destroy());
    answer.on("close", () => passed.destroy());
    asked.pipe(passed);
  });
  await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
  proxy.address = `http://127.0.0.1:${server.address().port}`;
  proxy.stop = () => {
    server.closeAllConnections();
    server.close();
  };
  return proxy;
}
