import type { Figures, Spread } from "../shared/protocol";
import { Extent } from "./extent";
import { centroid, FaceShape, isSeen, valences, type Surface } from "./surface";

const bins = 20;
const floor = 0.2;
/** Of the worst faces so many are listed. */
const listed = 20;

/** The faces of least stretch, in order; of equals the first ones. */
class Worst {
  readonly faces: { face: number; at: number; stretch: number; size: number }[] = [];

  /** `face` counts those that are seen, `at` all of them. */
  add(face: number, at: number, { stretch, size }: FaceShape): void {
    const { faces } = this;
    if (faces.length === listed && stretch >= faces[listed - 1]!.stretch) return;
    if (faces.length === listed) faces.pop();
    const before = faces.findIndex((one) => one.stretch > stretch);
    faces.splice(before < 0 ? faces.length : before, 0, { face, at, stretch, size });
  }
}

class Tally {
  private least = Infinity;
  private largest = -Infinity;
  private sum = 0;
  private count = 0;

  add(value: number): void {
    if (value < this.least) this.least = value;
    if (value > this.largest) this.largest = value;
    this.sum += value;
    ++this.count;
  }

  get spread(): Spread {
    return this.count > 0 ? [this.least, this.sum / this.count, this.largest] : [0, 0, 0];
  }
}

/** O(faces). */
export function measure(surface: Surface): Figures {
  const shape = new FaceShape();
  const histogram = new Array<number>(bins).fill(0);
  const stretch = new Tally(), size = new Tally(), valence = new Tally();
  const sizes = new Extent(), worst = new Worst();
  let faces = 0, below = 0;
  for (let f = 0; f < surface.faceCount; ++f) {
    if (!isSeen(surface, f)) continue;
    shape.measure(surface, f);
    worst.add(faces, f, shape);
    ++faces;
    stretch.add(shape.stretch);
    size.add(shape.size);
    sizes.add(shape.size);
    if (shape.stretch < floor) ++below;
    ++histogram[Math.min(bins - 1, Math.floor(shape.stretch * bins))]!;
  }
  const count = valences(surface);
  for (let v = surface.ghosts; v < surface.vertexCount; ++v) if (count[v]! > 0) valence.add(count[v]!);
  const spread = { stretch: stretch.spread, size: size.spread, valence: valence.spread };
  const [stretchMin, stretchMean] = spread.stretch;
  return {
    faces,
    stretchMin,
    stretchMean,
    facesBelow02: below,
    sizeMax: spread.size[2],
    valenceMax: spread.valence[2],
    histogram,
    spread,
    sizes: sizes.range,
    worst: worst.faces.map(({ at, ...face }) => ({ ...face, place: centroid(surface, at) })),
  };
}
