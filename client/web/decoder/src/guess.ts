import type { Star } from "./star.js";

/** Index of the height over the plane beside those of x, y and z. */
export const height = 3;

/**
 * Where to expect the two vertices of a split, as offsets from the vertex that is split: near the middle of the fan that goes over
 * lies the new one, near that of the rest the old one. The weights are part of the format. Bit for bit as in C++.
 */
export class Guess {
  private readonly fan = new Float64Array(4);
  private readonly rest = new Float64Array(4);
  private readonly ends = new Float64Array(4);
  /** Where the new vertex is, or is expected. */
  private readonly added = new Float64Array(4);
  private inFan = 0;
  private inRest = 0;

  /** The star begins with the fan, and `lie(steps)` was done. */
  begin(star: Star, steps: number): void {
    const { fan, rest, ends } = this;
    const { offsets, sums } = star;
    const inFan = (this.inFan = steps + 1), inRest = (this.inRest = star.valence - steps + 1);
    const from = 3 * star.slot(0), to = 3 * star.slot(steps);
    for (let axis = 0; axis < 3; ++axis) {
      fan[axis] = sums[axis]! / inFan;
      rest[axis] = sums[3 + axis]! / inRest;
      ends[axis] = (offsets[from + axis]! + offsets[to + axis]!) * 0.5;
    }
    raise(fan, star);
    raise(rest, star);
    raise(ends, star);
  }

  /** Fills in x, y, z and height. */
  forAdded(to: Float64Array): void {
    const { fan, rest, ends, added } = this;
    to[0] = 0.5 * fan[0]! - 0.2 * rest[0]! + 0.15 * ends[0]!;
    to[1] = 0.5 * fan[1]! - 0.2 * rest[1]! + 0.15 * ends[1]!;
    to[2] = 0.5 * fan[2]! - 0.2 * rest[2]! + 0.15 * ends[2]!;
    to[height] = 0.35 * fan[height]! - 0.15 * rest[height]! + 0.1 * ends[height]!;
    for (let n = 0; n < 4; ++n) added[n] = to[n]!;
  }

  /** `places`: from 3 on where the new vertex lies. */
  addedIs(star: Star, places: Float64Array): void {
    const { added } = this;
    for (let axis = 0; axis < 3; ++axis) added[axis] = places[3 + axis]! - star.centre[axis]!;
    raise(added, star);
  }

  forKept(to: Float64Array): void {
    const { fan, rest, ends, added } = this;
    for (let axis = 0; axis < 3; ++axis) {
      to[axis] = 0.55 * rest[axis]! - 0.4 * fan[axis]! + 0.1 * ends[axis]! + 0.4 * added[axis]!;
    }
    to[height] = 0.5 * rest[height]! - 0.35 * fan[height]! + 0.05 * ends[height]! + 0.4 * added[height]!;
  }

  /** The mean of the new vertex's ring, whose last is the old one, at `places`. */
  meanAroundAdded(to: Float64Array, { centre }: Star, places: Float64Array): void {
    const { fan, inFan } = this;
    for (let axis = 0; axis < 3; ++axis) to[axis] = (fan[axis]! * inFan + (places[axis]! - centre[axis]!)) / (inFan + 1);
  }

  /** The mean of the old vertex's ring, whose last is the new one, at `places` from 3 on. */
  meanAroundKept(to: Float64Array, { centre }: Star, places: Float64Array): void {
    const { rest, inRest } = this;
    for (let axis = 0; axis < 3; ++axis) to[axis] = (rest[axis]! * inRest + (places[3 + axis]! - centre[axis]!)) / (inRest + 1);
  }
}

/** Fills in the height of an offset over the star's plane, 0 where it has none. */
function raise(offset: Float64Array, { normal, across, hasPlane }: Star): void {
  offset[height] = hasPlane ? (normal[0]! * offset[0]! + normal[1]! * offset[1]! + normal[2]! * offset[2]!) / normal[across]! : 0;
}
