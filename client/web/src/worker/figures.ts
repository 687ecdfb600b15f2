import type { Figures } from "../shared/protocol";
import { FaceShape, isSeen, valences, type Surface } from "./surface";

const bins = 20;
const floor = 0.2;

/** O(faces). */
export function measure(surface: Surface): Figures {
  const shape = new FaceShape();
  const histogram = new Array<number>(bins).fill(0);
  let faces = 0, sum = 0, least = 1, below = 0, sizeMax = 0;
  for (let f = 0; f < surface.faceCount; ++f) {
    if (!isSeen(surface, f)) continue;
    shape.measure(surface, f);
    ++faces;
    sum += shape.stretch;
    if (shape.stretch < least) least = shape.stretch;
    if (shape.stretch < floor) ++below;
    if (shape.size > sizeMax) sizeMax = shape.size;
    ++histogram[Math.min(bins - 1, Math.floor(shape.stretch * bins))]!;
  }
  let valenceMax = 0;
  const count = valences(surface);
  for (let v = surface.ghosts; v < surface.vertexCount; ++v) valenceMax = Math.max(valenceMax, count[v]!);
  return { faces, stretchMin: faces > 0 ? least : 0, stretchMean: faces > 0 ? sum / faces : 0, facesBelow02: below, sizeMax, valenceMax, histogram };
}
