import { create, fromJson, type JsonValue } from "@bufbuild/protobuf";
import { RepresentationSchema, type Representation } from "../gen/vsplit/v1/meshing_pb";
import { Problem } from "../shared/problem";
import type { News, Order } from "../shared/protocol";
import { MeshWorker } from "./mesh_worker";

export type FileNews = Extract<News, { kind: "file" }>;

/** What a file says of itself, as far as it can be read, at the levels that it has. */
export function representationIn({ json, faces, facesMin, facesMax }: FileNews): Representation {
  let said: Representation;
  try {
    said = fromJson(RepresentationSchema, json as JsonValue, { ignoreUnknownFields: true });
  } catch {
    said = create(RepresentationSchema);
  }
  return Object.assign(said, { faces, facesMin, facesMax });
}

/** Has a worker read a .vsplit file, and hold its mesh; `read` is told how far it is. Rejects with a Problem, or when `signal` says so. */
export function readFile(file: File, colour: Order, read: (share: number) => void, signal: AbortSignal): Promise<{ worker: MeshWorker; news: FileNews }> {
  return new Promise((resolve, reject) => {
    const fail = (why: unknown): void => {
      worker.end();
      reject(why);
    };
    const giveUp = (): void => fail(new DOMException("cancelled", "AbortError"));
    const worker: MeshWorker = new MeshWorker((news) => {
      if (news.kind === "progress") read(news.fraction);
      if (news.kind === "problem") fail(new Problem(news.problem));
      if (news.kind !== "file") return;
      signal.removeEventListener("abort", giveUp);
      resolve({ worker, news });
    });
    signal.addEventListener("abort", giveUp);
    worker.tell(colour);
    worker.tell({ kind: "file", file });
  });
}
