import { expect, test } from "vitest";
import { measure } from "../src/worker/figures";

/** Two equilateral triangles of edge 2 that share one, and below them one with angles 90, 45, 45; vertices 0 to 4 lie in a plane. */
const rise = Math.sqrt(3);
const surface = {
  vertexCount: 5,
  faceCount: 3,
  ghosts: 0,
  positions: Float64Array.from([0, 0, 0, 2, 0, 0, 1, rise, 0, 3, rise, 0, 0, -2, 0]),
  corners: Uint32Array.from([0, 1, 2, 1, 3, 2, 0, 4, 1]),
};
/** sqrt(12) * inradius / longest edge; the inradius of legs 2 and 2 is (2 + 2 - hypotenuse) / 2. */
const hypotenuse = 2 * Math.SQRT2;
const right = (Math.sqrt(12) * (2 - Math.SQRT2)) / hypotenuse;

test("least, mean and largest are those of the faces and vertices", () => {
  const { spread, sizes } = measure(surface);
  expect(sizes).toEqual([2, hypotenuse]);
  const near = (spread: readonly number[], expected: number[]): void => expected.forEach((value, n) => expect(spread[n]).toBeCloseTo(value, 12));
  near(spread.stretch, [right, (2 + right) / 3, 1]);
  near(spread.size, [2, (4 + hypotenuse) / 3, hypotenuse]);
  // Faces at the vertices 0 to 4; no ghost tells of the boundary here.
  near(spread.valence, [1, 9 / 5, 3]);
});

test("a mesh without faces has no figures, and no infinite ones", () => {
  const { spread, stretchMin, sizeMax } = measure({ ...surface, faceCount: 0 });
  expect([...spread.stretch, ...spread.size, ...spread.valence, stretchMin, sizeMax]).toEqual(new Array(11).fill(0));
});
