import type { Element, Point } from "../shared/protocol";
import { centroid, FaceShape, isSeen, type Surface } from "./surface";

/** Where something is, and the longest edge of its faces, to look at it from a fitting distance. */
export interface PlaceOf {
  place: Point;
  size: number;
}

/** The n-th face of those that are seen: so they are numbered in files and by the server. */
function seenFace(surface: Surface, n: number): number | undefined {
  if (surface.ghosts === 0) return n < surface.faceCount ? n : undefined;
  for (let face = 0; face < surface.faceCount; ++face) if (isSeen(surface, face) && n-- === 0) return face;
  return undefined;
}

/** Where a face or vertex is, numbered as the server does; undefined where there is none. O(faces). */
export function placeOf(surface: Surface, { of, number }: Element): PlaceOf | undefined {
  const shape = new FaceShape();
  if (of === "face") {
    const face = seenFace(surface, number);
    if (face === undefined) return undefined;
    shape.measure(surface, face);
    return { place: centroid(surface, face), size: shape.size };
  }
  const vertex = surface.ghosts + number;
  if (vertex >= surface.vertexCount) return undefined;
  let size = 0;
  for (let at = 0; at < 3 * surface.faceCount; ++at) {
    const face = Math.floor(at / 3);
    if (surface.vertexAt(at) !== vertex || !isSeen(surface, face)) continue;
    shape.measure(surface, face);
    size = Math.max(size, shape.size);
  }
  const [x, y, z] = surface.positions.subarray(3 * vertex, 3 * vertex + 3);
  return { place: [x!, y!, z!], size };
}
