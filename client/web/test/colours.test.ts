import { expect, test } from "vitest";
import { Ramp, rangeOf } from "../src/shared/colours";

test("red is what no solver takes, and nothing else", () => {
  const ramp = new Ramp("stretch", rangeOf("stretch", 0));
  const [red, green] = [/rgb\((\d+)/, /rgb\(\d+ (\d+)/].map((pattern) => (value: number) => Number(pattern.exec(ramp.css(value))![1])) as [(v: number) => number, (v: number) => number];
  expect(green(0.19)).toBeLessThan(40);
  expect(green(0.21)).toBeGreaterThan(130);
  expect(red(1)).toBeLessThan(60);
});

test("what is beyond the range has the colour of its end", () => {
  for (const by of ["stretch", "size", "valence"] as const) {
    const ramp = new Ramp(by, rangeOf(by, 7));
    const [low, high] = ramp.range;
    expect(ramp.css(low - 1)).toBe(ramp.css(low));
    expect(ramp.css(high + 1)).toBe(ramp.css(high));
    expect(ramp.css(low)).not.toBe(ramp.css(high));
  }
});
