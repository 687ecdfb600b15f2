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

export type Range = readonly [least: number, largest: number];

/**
 * Colours by a number from the first to the last of `range`, looked up in 256 steps. Sizes go by their logarithm: a sliver of the
 * input is hundreds of times as long as a face of the result, and each is to be told from its like.
 */
export class Ramp {
  private readonly table = new Uint8Array(3 * 256);

  /** For sizes both ends of `range` are above 0. */
  constructor(readonly by: ColourBy, readonly range: Range) {
    const [low, high] = range;
    for (let n = 0; n < 256; ++n) {
      // Sizes are coloured by their share of the range, the others by what they are.
      const share = n / 255;
      this.table.set(at(stops[by], by === "size" ? share : low + share * (high - low)), 3 * n);
    }
  }

  put(value: number, to: Uint8Array, offset: number): void {
    const n = this.entry(this.shareOf(value));
    to[offset] = this.table[n]!;
    to[offset + 1] = this.table[n + 1]!;
    to[offset + 2] = this.table[n + 2]!;
  }

  css(value: number): string {
    return this.cssAt(this.shareOf(value));
  }

  /** At a share of the way from the range's low end to its high one. */
  cssAt(share: number): string {
    const n = this.entry(share);
    return `rgb(${this.table.subarray(n, n + 3).join(" ")})`;
  }

  private entry(share: number): number {
    return 3 * Math.min(255, Math.max(0, Math.round(share * 255)));
  }

  private shareOf(value: number): number {
    const [low, high] = this.range;
    if (!(high > low)) return 0;
    if (this.by !== "size") return (value - low) / (high - low);
    return value > 0 ? Math.log(value / low) / Math.log(high / low) : 0;
  }
}

/** Where there are no numbers: joined to a range it leaves that one. */
export const nothing: Range = [Infinity, 0];

export function joined(one: Range, other: Range): Range {
  return [Math.min(one[0], other[0]), Math.max(one[1], other[1])];
}

/** Outwards to one significant digit: a range that is easy to read, and stays when a mesh changes a little. */
function rounded([least, largest]: Range): Range {
  const near = (value: number): number => Number(value.toPrecision(1));
  const unit = (value: number): number => 10 ** Math.floor(Math.log10(value));
  const low = near(least), high = near(largest);
  return [low <= least ? low : near(low - unit(least)), high >= largest ? high : near(high + unit(largest))];
}

/** The range that a colour stands for. `sizes`: the least above 0 and the largest of all faces that are drawn. */
export function rangeOf(by: ColourBy, sizes: Range): Range {
  if (by === "stretch") return [0, 1];
  if (by === "valence") return [3, 12];
  return sizes[1] > 0 ? rounded(sizes) : [1, 1];
}
