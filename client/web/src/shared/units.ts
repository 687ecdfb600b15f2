import { LengthUnit } from "../gen/vsplit/v1/meshing_pb";

const symbols: Partial<Record<LengthUnit, string>> = {
  [LengthUnit.MICROMETRE]: "µm",
  [LengthUnit.MILLIMETRE]: "mm",
  [LengthUnit.CENTIMETRE]: "cm",
  [LengthUnit.METRE]: "m",
  [LengthUnit.INCH]: "in",
  [LengthUnit.FOOT]: "ft",
};

/** "mm"; empty where the unit is not known. */
export const symbolOf = (unit: LengthUnit | undefined): string => (unit === undefined ? "" : (symbols[unit] ?? ""));

/** A length's text with its unit behind it. */
export const withUnit = (text: string, unit: string): string => (unit ? `${text} ${unit}` : text);
