import { expect, test } from "vitest";
import { LengthUnit, LengthUnitSchema } from "../src/gen/vsplit/v1/meshing_pb";
import { formatLabel } from "../src/page/schema";
import { symbolOf, withUnit } from "../src/shared/units";

test("every unit of the contract has a symbol of its own, and none where it is not known", () => {
  const units = LengthUnitSchema.values.map((value) => symbolOf(value.number as LengthUnit));
  expect(units[0]).toBe("");
  expect(new Set(units).size).toBe(LengthUnitSchema.values.length);
  expect(symbolOf(undefined)).toBe("");
});

test("lengths have their unit behind them", () => {
  expect(withUnit("1.5", symbolOf(LengthUnit.MILLIMETRE))).toBe("1.5 mm");
  expect(withUnit("1.5", "")).toBe("1.5");
});

test("formats are written as people do", () => {
  expect(formatLabel("THREE_MF")).toBe("3mf");
  expect(formatLabel("STL_ASCII")).toBe("stl ascii");
});
