import { expect, test } from "vitest";
import { measure } from "../src/worker/figures";

const at = (corners: number[]) => (corner: number) => corners[corner]!;

/** Two equilateral triangles of edge 2 that share one, and below them one with angles 90, 45, 45; vertices 0 to 4 lie in a plane. */
const rise = Math.sqrt(3);
const surface = {
  vertexCount: 5,
  faceCount: 3,
  ghosts: 0,
  positions: Float64Array.from([0, 0, 0, 2, 0, 0, 1, rise, 0, 3, rise, 0, 0, -2, 0]),
  vertexAt: at([0, 1, 2, 1, 3, 2, 0, 4, 1]),
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
  // Edges at the vertices 0 to 4: 3, 4, 3, 2, 2... of seven edges, each counted at both its ends.
  near(spread.valence, [2, 14 / 5, 4]);
});

test("an edge of many faces is one edge, as it is to the server", () => {
  // Three faces share the edge 0 1: at its ends it and one edge a face.
  const fan = { vertexCount: 5, faceCount: 3, ghosts: 0, positions: Float64Array.from([0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0, -1, -1, 0]), vertexAt: at([0, 1, 2, 0, 1, 3, 0, 1, 4]) };
  expect(measure(fan).valenceMax).toBe(4);
});

test("a mesh without faces has no figures, and no infinite ones", () => {
  const { spread, stretchMin, sizeMax } = measure({ ...surface, faceCount: 0 });
  expect([...spread.stretch, ...spread.size, ...spread.valence, stretchMin, sizeMax]).toEqual(new Array(11).fill(0));
});

test("the worst faces come first, of equals the first, twenty at most, with their middles", () => {
  // Thirty triangles in a row, by turns of three heights; the lower the worse.
  const heights = Array.from({ length: 30 }, (_, n) => [1, 0.2, 0.6][n % 3]!);
  const positions = Float64Array.from(heights.flatMap((high, n) => [3 * n, 0, 0, 3 * n + 2, 0, 0, 3 * n + 1, high, 0]));
  const vertexAt = (corner: number) => corner;
  const { worst } = measure({ vertexCount: 90, faceCount: 30, ghosts: 0, positions, vertexAt });
  const expected = [...[1, 4, 7, 10, 13, 16, 19, 22, 25, 28], ...[2, 5, 8, 11, 14, 17, 20, 23, 26, 29]];
  expect(worst.map(({ face }) => face)).toEqual(expected);
  expect(worst[0]!.place[0]).toBeCloseTo(4, 12);
  expect(worst[0]!.place[1]).toBeCloseTo(0.2 / 3, 12);
  expect(worst[0]!.size).toBe(2);
  // Faces of ghosts are not counted: numbers are those of the server.
  const open = measure({ vertexCount: 90, faceCount: 30, ghosts: 3, positions, vertexAt });
  expect(open.worst[0]!.face).toBe(0);
});
