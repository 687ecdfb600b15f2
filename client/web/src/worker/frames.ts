import { fromBinary } from "@bufbuild/protobuf";
import { ProgressiveEventSchema, type ProgressiveEvent } from "../gen/vsplit/v1/meshing_pb";

/** Cuts a stream into messages, each with its length before it as a varint. */
export class FrameReader {
  private held = new Uint8Array(0);

  /** The messages that are whole now. Throws where a length is none. */
  push(bytes: Uint8Array): ProgressiveEvent[] {
    const all = new Uint8Array(this.held.length + bytes.length);
    all.set(this.held);
    all.set(bytes, this.held.length);
    const events: ProgressiveEvent[] = [];
    let at = 0;
    for (;;) {
      const head = lengthAt(all, at);
      if (!head || at + head.bytes + head.length > all.length) break;
      at += head.bytes;
      events.push(fromBinary(ProgressiveEventSchema, all.subarray(at, at + head.length)));
      at += head.length;
    }
    this.held = all.slice(at);
    return events;
  }

  get empty(): boolean {
    return this.held.length === 0;
  }
}

function lengthAt(bytes: Uint8Array, at: number): { length: number; bytes: number } | undefined {
  let length = 0;
  for (let n = 0; n < 5; ++n) {
    const byte = bytes[at + n];
    if (byte === undefined) return undefined;
    length += (byte & 0x7f) * 2 ** (7 * n);
    if (byte < 0x80) return { length, bytes: n + 1 };
  }
  throw new Error("the stream of events is broken: a length of more than 32 bits");
}

/** Events of a response, as they come. */
export async function* eventsOf(response: Response): AsyncGenerator<ProgressiveEvent> {
  const frames = new FrameReader();
  const reader = response.body!.getReader();
  try {
    for (;;) {
      const { done, value } = await reader.read();
      if (done) break;
      yield* frames.push(value);
    }
    if (!frames.empty) throw new Error("the stream of events broke off");
  } finally {
    await reader.cancel().catch(() => undefined);
  }
}
