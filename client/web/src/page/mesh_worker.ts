import type { News, Order } from "../shared/protocol";

/** A worker that holds one of the two meshes. */
export class MeshWorker {
  private readonly worker = new Worker(new URL("../worker/worker.ts", import.meta.url), { type: "module", name: "mesh" });

  constructor(heard: (news: News) => void) {
    this.worker.onmessage = ({ data }: MessageEvent<News>) => heard(data);
    this.worker.onerror = (event) => heard({ kind: "problem", problem: { cause: "INTERNAL", detail: event.message || "the worker could not be started" } });
  }

  tell(order: Order): void {
    this.worker.postMessage(order);
  }

  end(): void {
    this.worker.terminate();
  }
}
