import { access } from "../shared/access";
import type { News, Order } from "../shared/protocol";

/** A worker that holds one of the two meshes. */
export class MeshWorker {
  private readonly worker = new Worker(new URL("../worker/worker.ts", import.meta.url), { type: "module", name: "mesh" });

  private orders = 0;

  /** `heard` is called when `busy` is up to date; another may be put in its place. */
  constructor(public heard: (news: News) => void) {
    this.worker.onmessage = ({ data }: MessageEvent<News>) => {
      if (data.kind === "idle") --this.orders;
      this.heard(data);
    };
    this.tell({ kind: "token", token: access.token });
    this.worker.onerror = (event) => this.heard({ kind: "problem", problem: { cause: "INTERNAL", detail: event.message || "the worker could not be started" } });
  }

  /** Whether it still has orders to carry out. */
  get busy(): boolean {
    return this.orders > 0;
  }

  tell(order: Order): void {
    ++this.orders;
    this.worker.postMessage(order);
  }

  end(): void {
    this.worker.terminate();
  }
}
