import { expect, test } from "vitest";
import { refusal } from "../src/page/number_field";

const uint32 = [0, 4294967295] as const;

test("whole numbers are whole, and within what their type has", () => {
  for (const good of ["", "0", "12", "1e3", "4294967295"]) expect(refusal(good, false, uint32)).toBeUndefined();
  for (const bad of ["1.5", "-5", "1e30", "4294967296", "1e-3"]) {
    expect(refusal(bad, false, uint32)).toBe(`${bad} is not accepted; accepted is a whole number from 0 to 4294967295`);
  }
});

test("what is no number is not taken for an empty field", () => {
  expect(refusal("", true)).toMatch(/^this is no number; accepted is a number/);
  expect(refusal("", false)).toBeUndefined();
  expect(refusal("1e999", false)).toMatch(/not accepted/);
  for (const good of ["0.5", "-2e-3", "0"]) expect(refusal(good, false)).toBeUndefined();
});
