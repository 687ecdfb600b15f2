import { create, toBinary } from "@bufbuild/protobuf";
import { expect, test } from "vitest";
import { ProgressiveEventSchema } from "../src/gen/vsplit/v1/meshing_pb";
import { FrameReader } from "../src/worker/frames";

function frame(faces: number, stage = "simplify"): Uint8Array {
  const bytes = toBinary(ProgressiveEventSchema, create(ProgressiveEventSchema, { event: { case: "progress", value: { stage, fraction: 0.5, faces } } }));
  const head: number[] = [];
  for (let n = bytes.length; ; n >>>= 7) {
    head.push(n >= 0x80 ? (n & 0x7f) | 0x80 : n);
    if (n < 0x80) break;
  }
  return Uint8Array.from([...head, ...bytes]);
}

test("messages come whole, however the stream is cut", () => {
  const all = [1, 2, 300, 4].map((n) => frame(n, "x".repeat(n)));
  const stream = Uint8Array.from(all.flatMap((part) => [...part]));
  for (const size of [1, 2, 3, 7, 100, stream.length]) {
    const reader = new FrameReader();
    const faces: number[] = [];
    for (let at = 0; at < stream.length; at += size) {
      for (const { event } of reader.push(stream.subarray(at, at + size))) if (event.case === "progress") faces.push(event.value.faces);
    }
    expect(faces).toEqual([1, 2, 300, 4]);
    expect(reader.empty).toBe(true);
  }
});

test("a stream that ends within a message is noticed", () => {
  const reader = new FrameReader();
  expect(reader.push(frame(5).subarray(0, 4))).toEqual([]);
  expect(reader.empty).toBe(false);
});

test("a length beyond 32 bits is no length", () => {
  expect(() => new FrameReader().push(new Uint8Array(6).fill(0xff))).toThrow(/broken/);
});
