import { CorruptError } from "./errors.js";
import type { Star } from "./star.js";

export const enum Encoding {
  Float64 = 1,
  Float32 = 2,
  Quantised = 3,
}

/** The positions that a stream can hold, as its base mesh says. */
export interface Grid {
  encoding: Encoding;
  /** Quantised only; 0 otherwise. */
  bits: number;
  origin: readonly [number, number, number];
  step: number;
}

export const float64Grid: Grid = { encoding: Encoding.Float64, bits: 0, origin: [0, 0, 0], step: 0 };
export const float32Grid: Grid = { encoding: Encoding.Float32, bits: 0, origin: [0, 0, 0], step: 0 };

/** The least number that has a reciprocal; codes come from a product with that of the step. */
const leastStep = 2 ** -1022;
/** Beyond this no coordinate is accepted. */
export const largestCoordinate = 1e15;

const f64 = new Float64Array(1);
const f64Words = new Uint32Array(f64.buffer);
const f32 = new Float32Array(1);
const f32Word = new Uint32Array(f32.buffer);
f64[0] = 1;
const highWord = f64Words[1] === 0x3ff00000 ? 1 : 0;

function exponentField(value: number): number {
  f64[0] = value;
  return (f64Words[highWord]! >>> 20) & 0x7ff;
}

/** How many binary digits a whole number below 2^32 has. */
const digits = (value: number): number => 32 - Math.clz32(value);

function clampScale(scale: number): number {
  return scale < 0 ? 0 : scale > 31 ? 31 : scale;
}

/** Coordinates as whole numbers in their order. */
export interface Codes {
  /** The coordinate whose code is `residual` beyond that of `expected`, modulo 2^32; NaN where there is none. */
  decode(expected: number, residual: number, axis: number): number;
  scale(length: number, at: number): number;
  /** Fills in the scales of a star that lies: of its reach along x, y and z, and of its thickness. */
  scales(star: Star, to: Int32Array): void;
}

class Float32Codes implements Codes {
  decode(expected: number, residual: number, _axis: number): number {
    f32[0] = expected;
    const bits = f32Word[0]! | 0;
    const code = ((bits ^ ((bits >> 31) | 0x80000000)) + residual) | 0;
    f32Word[0] = code ^ (~(code >> 31) | 0x80000000);
    const value = f32[0]!;
    return Math.abs(value) <= largestCoordinate ? value : NaN;
  }
  scale(length: number, at: number): number {
    if (length === 0) return 0;
    return clampScale(exponentField(length) - exponentField(at) + 24);
  }
  scales({ valence, offsets, normal, across, hasPlane, centre }: Star, to: Int32Array): void {
    const n0 = normal[0]!, n1 = normal[1]!, n2 = normal[2]!;
    let rx = 0, ry = 0, rz = 0, thickness = 0;
    for (let at = 0; at < 3 * valence; at += 3) {
      const x = offsets[at]!, y = offsets[at + 1]!, z = offsets[at + 2]!;
      rx = Math.max(rx, Math.abs(x));
      ry = Math.max(ry, Math.abs(y));
      rz = Math.max(rz, Math.abs(z));
      thickness = Math.max(thickness, Math.abs(n0 * x + n1 * y + n2 * z));
    }
    to[0] = this.scale(rx, centre[0]!);
    to[1] = this.scale(ry, centre[1]!);
    to[2] = this.scale(rz, centre[2]!);
    to[3] = hasPlane ? this.scale(thickness / Math.abs(normal[across]!), centre[across]!) : 0;
  }
}

class QuantisedCodes implements Codes {
  private readonly origin: Float64Array;
  private readonly step: number;
  private readonly perUnit: number;
  private readonly most: number;

  constructor(grid: Grid) {
    this.origin = Float64Array.from(grid.origin);
    this.step = grid.step;
    this.perUnit = 1 / grid.step;
    this.most = 2 ** grid.bits - 1;
  }
  decode(expected: number, residual: number, axis: number): number {
    const { most } = this;
    const origin = this.origin[axis]!;
    const upper = (expected - origin) * this.perUnit + 0.5; // what is whole of it, when not below 0, is the nearest
    const code = ((upper > 0 ? (upper < most ? upper | 0 : most) : 0) + residual) | 0;
    return code >= 0 && code <= most ? origin + code * this.step : NaN;
  }
  scale(length: number, _at: number): number {
    return digits(this.steps(length));
  }
  /** Nobody can foresee which neighbour is the farthest, but the largest of some numbers has as many digits as all of them joined by `or`. */
  scales({ valence, offsets, normal, across, hasPlane }: Star, to: Int32Array): void {
    const n0 = normal[0]!, n1 = normal[1]!, n2 = normal[2]!;
    const steep = hasPlane ? Math.abs(normal[across]!) : 1;
    let rx = 0, ry = 0, rz = 0, thickness = 0;
    for (let at = 0; at < 3 * valence; at += 3) {
      const x = offsets[at]!, y = offsets[at + 1]!, z = offsets[at + 2]!;
      rx |= this.steps(Math.abs(x));
      ry |= this.steps(Math.abs(y));
      rz |= this.steps(Math.abs(z));
      thickness |= this.steps(Math.abs(n0 * x + n1 * y + n2 * z) / steep);
    }
    to[0] = digits(rx);
    to[1] = digits(ry);
    to[2] = digits(rz);
    to[3] = digits(thickness);
  }
  /** How many whole steps a length has, 2^31 - 1 at most. */
  private steps(length: number): number {
    const steps = length * this.perUnit;
    return steps < 2147483647 ? steps | 0 : 2147483647;
  }
}

export function codesOf(grid: Grid): Codes {
  if (grid.encoding === Encoding.Float32) return new Float32Codes();
  if (grid.encoding !== Encoding.Quantised) throw new CorruptError(`encoding ${grid.encoding} is unknown; 1, 2 and 3 are known`);
  const end = grid.step * (2 ** grid.bits - 1);
  const reach = Math.max(...grid.origin.map((o) => Math.max(Math.abs(o), Math.abs(o + end))));
  if (!(grid.bits >= 10 && grid.bits <= 24 && grid.step >= leastStep && reach <= largestCoordinate)) {
    throw new CorruptError(`a grid of ${grid.bits} bits in steps of ${grid.step}; accepted are 10 to 24 bits and steps from ${leastStep} on`);
  }
  return new QuantisedCodes(grid);
}
