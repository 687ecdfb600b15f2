import { readFileSync } from "node:fs";
import { expect, test } from "vitest";
import { readGolden } from "../decoder/test/golden";
import { placeOf } from "../src/worker/places";
import { isSeen, type Surface } from "../src/worker/surface";

const at = (corners: ArrayLike<number>) => (corner: number) => corners[corner]!;

/** A ghost, vertex 0, whose faces 0 and 2 are not seen; the others are triangles of legs 2 and 4. */
const surface: Surface = {
  vertexCount: 5,
  faceCount: 4,
  ghosts: 1,
  positions: Float64Array.from([9, 9, 9, 0, 0, 0, 2, 0, 0, 0, 2, 0, 4, 4, 6]),
  vertexAt: at([0, 2, 1, 1, 2, 3, 0, 1, 3, 2, 4, 3]),
};

test("faces and vertices are numbered without those that are not seen", () => {
  expect(placeOf(surface, { of: "face", number: 0 })).toEqual({ place: [2 / 3, 2 / 3, 0], size: Math.sqrt(8) });
  expect(placeOf(surface, { of: "face", number: 1 })!.place).toEqual([2, 2, 2]);
  expect(placeOf(surface, { of: "face", number: 2 })).toBeUndefined();
  expect(placeOf(surface, { of: "vertex", number: 3 })).toEqual({ place: [4, 4, 6], size: Math.sqrt(4 + 16 + 36) });
  expect(placeOf(surface, { of: "vertex", number: 0 })).toEqual({ place: [0, 0, 0], size: Math.sqrt(8) });
  expect(placeOf(surface, { of: "vertex", number: 4 })).toBeUndefined();
});

test("every face of an open mesh has its number", () => {
  const { base } = readGolden(readFileSync(new URL("../../../tests/data/golden/records_1_float32_open.golden", import.meta.url), "utf8"));
  const { positions, ghosts, corners } = base;
  const open: Surface = { positions, ghosts, vertexCount: positions.length / 3, faceCount: corners.length / 3, vertexAt: at(corners) };
  expect(open.ghosts).toBeGreaterThan(0);
  let number = 0;
  for (let face = 0; face < open.faceCount; ++face) {
    if (!isSeen(open, face)) continue;
    const mean = [0, 1, 2].map((axis) => [0, 1, 2].reduce((sum, c) => sum + open.positions[3 * open.vertexAt(3 * face + c) + axis]!, 0) / 3);
    expect(placeOf(open, { of: "face", number: number++ })!.place).toEqual(mean);
  }
  expect(placeOf(open, { of: "face", number })).toBeUndefined();
});
