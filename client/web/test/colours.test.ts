import { expect, test } from "vitest";
import { joined, nothing, Ramp, rangeOf } from "../src/shared/colours";

test("red is what no solver takes, and nothing else", () => {
  const ramp = new Ramp("stretch", rangeOf("stretch", nothing));
  const [red, green] = [/rgb\((\d+)/, /rgb\(\d+ (\d+)/].map((pattern) => (value: number) => Number(pattern.exec(ramp.css(value))![1])) as [(v: number) => number, (v: number) => number];
  expect(green(0.19)).toBeLessThan(40);
  expect(green(0.21)).toBeGreaterThan(130);
  expect(red(1)).toBeLessThan(60);
});

test("what is beyond the range has the colour of its end", () => {
  for (const by of ["stretch", "size", "valence"] as const) {
    const ramp = new Ramp(by, rangeOf(by, [0.5, 7]));
    const [low, high] = ramp.range;
    expect(ramp.css(low - 1)).toBe(ramp.css(low));
    expect(ramp.css(high + 1)).toBe(ramp.css(high));
    expect(ramp.css(low)).not.toBe(ramp.css(high));
  }
});

test("sizes are coloured by their logarithm, from the least to the largest", () => {
  const ramp = new Ramp("size", [0.1, 1000]);
  expect(ramp.css(10)).toBe(ramp.cssAt(0.5));
  expect(ramp.css(1)).toBe(ramp.cssAt(0.25));
  expect(ramp.css(1)).not.toBe(ramp.css(2));
  expect(ramp.css(0)).toBe(ramp.cssAt(0));
});

test("the range of sizes has all of them, and clean ends", () => {
  expect(rangeOf("size", [0.483, 132.7])).toEqual([0.4, 200]);
  expect(rangeOf("size", [0.3, 0.7])).toEqual([0.3, 0.7]);
  expect(rangeOf("size", [0.0951, 9.51])).toEqual([0.09, 10]);
  for (const sizes of [[1.0000001, 9.9999], [2, 2], [3e-7, 8.1e12]] as const) {
    const [low, high] = rangeOf("size", sizes);
    expect(low).toBeLessThanOrEqual(sizes[0]);
    expect(high).toBeGreaterThanOrEqual(sizes[1]);
  }
  expect(joined(nothing, [2, 3])).toEqual([2, 3]);
});
