import { expect, test } from "vitest";
import { Colouring } from "../src/page/colouring";
import type { Range } from "../src/shared/colours";
import type { Patch } from "../src/shared/protocol";

const patch = (faces: number, slots: number, sizes: Range): Patch => ({
  slots, sizes, runs: Uint32Array.of(0, faces), positions: new Float32Array(9 * faces), colours: new Uint8Array(9 * faces), visible: slots, milliseconds: 0, records: 0,
});

test("input and result share a range that has every face that is drawn", () => {
  const told: Range[] = [];
  const colouring: Colouring = new Colouring(() => told.push(colouring.range));
  colouring.choose("size");
  colouring.take("source", patch(100, 100, [0.5, 90]));
  expect(colouring.range).toEqual([0.5, 90]);
  colouring.take("result", patch(100, 100, [0.2, 7]));
  expect(colouring.range).toEqual([0.2, 90]);
  colouring.take("result", patch(3, 100, [1, 200]));
  expect(colouring.range).toEqual([0.2, 200]);
  const before = told.length;
  colouring.take("result", patch(3, 100, [2, 150])); // within: nothing is coloured anew
  expect(told.length).toBe(before);
  colouring.measured("result", [3, 8]); // the largest is gone
  expect(colouring.range).toEqual([0.5, 90]);
  colouring.show("result"); // the only one that is drawn
  expect(colouring.range).toEqual([3, 8]);
  colouring.show("both");
  colouring.take("result", patch(0, 0, [Infinity, 0])); // a method that was cancelled: no result
  expect(colouring.range).toEqual([0.5, 90]);
});

test("stretch and valence have ranges of their own", () => {
  const colouring = new Colouring(() => undefined);
  colouring.take("source", patch(10, 10, [0.5, 90]));
  expect(colouring.range).toEqual([0, 1]);
  colouring.choose("valence");
  expect(colouring.range).toEqual([3, 12]);
  colouring.choose("size");
  expect(colouring.range).toEqual([0.5, 90]);
});
