/** What a face is coloured by. */
export type ColourBy = "stretch" | "size" | "valence";

type Rgb = readonly [number, number, number];
type Stop = readonly [number, Rgb];

// Below 0.2 no solver takes a face: there the ramp jumps.
const stretchStops: readonly Stop[] = [
  [0, [122, 0, 22]],
  [0.2, [214, 32, 39]],
  [0.2, [246, 138, 48]],
  [0.45, [250, 214, 72]],
  [0.7, [78, 183, 134]],
  [1, [52, 132, 214]],
];
const sizeStops: readonly Stop[] = [
  [0, [62, 73, 137]],
  [0.33, [38, 130, 142]],
  [0.66, [108, 205, 89]],
  [1, [253, 231, 37]],
];
const valenceStops: readonly Stop[] = [
  [3, [49, 54, 149]],
  [5, [145, 191, 219]],
  [6, [222, 226, 230]],
  [7, [253, 190, 120]],
  [9, [215, 48, 39]],
  [12, [122, 0, 22]],
];

const stops = { stretch: stretchStops, size: sizeStops, valence: valenceStops } as const;

function at(ramp: readonly Stop[], value: number): Rgb {
  let below = ramp[0]!;
  for (const stop of ramp) {
    if (value < stop[0]) {
      const share = (value - below[0]) / (stop[0] - below[0]);
      return [0, 1, 2].map((c) => Math.round(below[1][c]! + share * (stop[1][c]! - below[1][c]!))) as unknown as Rgb;
    }
    below = stop;
  }
  return below[1];
}

/** Colours by a number from the first to the last of `range`, looked up in 256 steps. */
export class Ramp {
  private readonly table = new Uint8Array(3 * 256);

  constructor(by: ColourBy, readonly range: readonly [number, number]) {
    const ramp = stops[by];
    for (let n = 0; n < 256; ++n) {
      // Sizes are coloured by their share of the range, the others by what they are.
      const share = n / 255;
      const value = by === "size" ? share : range[0] + share * (range[1] - range[0]);
      this.table.set(at(ramp, value), 3 * n);
    }
  }

  put(value: number, to: Uint8Array, offset: number): void {
    const [low, high] = this.range;
    const share = high > low ? (value - low) / (high - low) : 0;
    const n = 3 * Math.min(255, Math.max(0, Math.round(share * 255)));
    to[offset] = this.table[n]!;
    to[offset + 1] = this.table[n + 1]!;
    to[offset + 2] = this.table[n + 2]!;
  }

  css(value: number): string {
    const rgb = new Uint8Array(3);
    this.put(value, rgb, 0);
    return `rgb(${rgb.join(" ")})`;
  }
}

/** The range that a colour stands for; sizes reach to the largest there is. */
export function rangeOf(by: ColourBy, sizeMax: number): readonly [number, number] {
  if (by === "stretch") return [0, 1];
  return by === "valence" ? [3, 12] : [0, sizeMax];
}
