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
