import { Vector3 } from "three";
import { expect, test } from "vitest";
import { normalOfFaceAt, sizeAt, vantage, type Drawn } from "../src/page/vantage";

type Corner = readonly [number, number, number];

/** A box around `middle`, its faces outwards. */
function box(middle: Corner, half: Corner): number[] {
  const floats: number[] = [];
  for (let axis = 0; axis < 3; ++axis) {
    for (const sign of [1, -1]) {
      const corner = (u: number, v: number): number[] => {
        const at = [0, 0, 0];
        at[axis] = sign;
        at[(axis + 1) % 3] = u * sign;
        at[(axis + 2) % 3] = v;
        return at.map((value, n) => middle[n]! + value * half[n]!);
      };
      floats.push(...corner(-1, -1), ...corner(1, -1), ...corner(1, 1), ...corner(-1, -1), ...corner(1, 1), ...corner(-1, 1));
    }
  }
  return floats;
}

const drawn = (...boxes: number[][]): Drawn => {
  const positions = Float32Array.from(boxes.flat());
  return { positions, floats: positions.length };
};
const from = new Vector3(0.55, 0.4, 1).normalize();

test("a face is looked at from outside of it", () => {
  for (const [x, y, z] of [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]] as const) {
    const { away, free } = vantage(drawn(box([0, 0, 0], [1, 1, 1])), new Vector3(x, y, z), 0.2, 5, from);
    expect(free).toBe(true);
    expect(away.dot(new Vector3(x, y, z))).toBeGreaterThan(0.3);
    expect(away.length()).toBeCloseTo(1, 9);
  }
});

test("the rim of a thin plate is looked at across the plate, not along it", () => {
  const plate = drawn(box([0, 0, 0], [50, 50, 0.01]));
  const { away, free } = vantage(plate, new Vector3(50, 0, 0), 2, 20, new Vector3(1, 0, 0));
  expect(free).toBe(true);
  expect(Math.abs(away.z)).toBeGreaterThan(0.8);
});

test("what stands in the way is looked past, from another side", () => {
  const wall = drawn(box([0, 0, 0], [1, 1, 1]), box([0, 0, 3], [3, 3, 0.1]));
  const { away, free } = vantage(wall, new Vector3(0.9, 0, 1), 0.3, 8, from);
  expect(free).toBe(true);
  // Between the box and the wall there are 1.9.
  expect(away.z * 8).toBeLessThan(8);
  expect(Math.abs(away.z) < 1.9 / 2.2 || away.z < 0).toBe(true);
});

test("a place that is shut in is not free", () => {
  const shut = drawn(box([0, 0, 0], [1, 1, 1]), box([0, 0, 0], [3, 3, 3]));
  const { away, free } = vantage(shut, new Vector3(0, 0, 1), 0.2, 10, from);
  expect(free).toBe(false);
  expect(away.z).toBeGreaterThan(0.3);
});

test("where there is no face the eye stays where it is", () => {
  const { away, free } = vantage(drawn(), new Vector3(), 1, 5, from);
  expect(free && away.dot(from)).toBeCloseTo(1, 9);
  expect(sizeAt(drawn(), new Vector3(), 1)).toBeUndefined();
});

test("the size at a place is that of the smallest face there", () => {
  const two = drawn(box([0, 0, 0], [10, 10, 10]), box([0, 0, 10.5], [0.5, 0.5, 0.5]));
  expect(sizeAt(two, new Vector3(0, 0, 10), 1)).toBeCloseTo(Math.SQRT2, 6);
  expect(sizeAt(two, new Vector3(10, 0, 0), 1)).toBeCloseTo(20 * Math.SQRT2, 4);
  expect(sizeAt(two, new Vector3(0, 0, 0), 1)).toBeUndefined();
});

test("a face that is named is looked at, however small it is beside what is around it", () => {
  const plate = drawn(box([0, 0, 0], [50, 50, 0.5]));
  const rim = new Vector3(50, 50 / 3, -0.5 / 3); // the middle of one of its faces
  const normal = normalOfFaceAt(plate, rim)!;
  expect(normal.x).toBeCloseTo(1, 9);
  const now = new Vector3(0, 0.2, 1).normalize();
  const { away, free } = vantage(plate, rim, 2, 20, now, normal);
  expect(free).toBe(true);
  expect(away.x).toBeGreaterThan(0.8);
  // One that is next to nothing has no side to look at.
  const sliver = Float32Array.from([0, 0, 0, 1, 0, 0, 0.5, 1e-5, 0]);
  expect(normalOfFaceAt({ positions: sliver, floats: 9 }, new Vector3())).toBeUndefined();
});
