import type { Point } from "../shared/protocol";

/** A mesh as the workers look at it: a ProgressiveMesh, or one read from a file. */
export interface Surface {
  readonly vertexCount: number;
  readonly faceCount: number;
  /** Vertices 0 to ghosts - 1 close boundaries; their faces are not seen. */
  readonly ghosts: number;
  readonly positions: Float64Array;
  /** The vertex at a corner; corner 3f + c is the c-th of face f. */
  vertexAt(corner: number): number;
}

export function isSeen(surface: Surface, face: number): boolean {
  const { ghosts } = surface;
  if (ghosts === 0) return true;
  const at = 3 * face;
  return surface.vertexAt(at) >= ghosts && surface.vertexAt(at + 1) >= ghosts && surface.vertexAt(at + 2) >= ghosts;
}

/** The middle of a face. */
export function centroid(surface: Surface, face: number): Point {
  const mean = (axis: number): number => [0, 1, 2].reduce((sum, c) => sum + surface.positions[3 * surface.vertexAt(3 * face + c) + axis]!, 0) / 3;
  return [mean(0), mean(1), mean(2)];
}

/** Stretch and longest edge of a face, without making anything. */
export class FaceShape {
  stretch = 0;
  size = 0;

  measure(surface: Surface, face: number): void {
    const { positions } = surface;
    const a = 3 * surface.vertexAt(3 * face), b = 3 * surface.vertexAt(3 * face + 1), c = 3 * surface.vertexAt(3 * face + 2);
    const ax = positions[a]!, ay = positions[a + 1]!, az = positions[a + 2]!;
    const ux = positions[b]! - ax, uy = positions[b + 1]! - ay, uz = positions[b + 2]! - az;
    const vx = positions[c]! - ax, vy = positions[c + 1]! - ay, vz = positions[c + 2]! - az;
    const wx = vx - ux, wy = vy - uy, wz = vz - uz;
    const ab = Math.sqrt(ux * ux + uy * uy + uz * uz);
    const ac = Math.sqrt(vx * vx + vy * vy + vz * vz);
    const bc = Math.sqrt(wx * wx + wy * wy + wz * wz);
    const nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
    const twiceArea = Math.sqrt(nx * nx + ny * ny + nz * nz);
    this.size = Math.max(ab, ac, bc);
    // sqrt(12) * inradius / longest edge, the inradius being twice the area over the perimeter.
    this.stretch = this.size > 0 ? (Math.sqrt(12) * twiceArea) / ((ab + bc + ac) * this.size) : 0;
  }
}

/** For each vertex, where the corners at it begin in a list that is ordered by vertex, of faces that are seen. */
function cornersByVertex(surface: Surface): { first: Uint32Array; faces: Uint32Array } {
  const { faceCount, vertexCount } = surface;
  const first = new Uint32Array(vertexCount + 1);
  const each = (visit: (vertex: number, face: number) => void): void => {
    for (let f = 0; f < faceCount; ++f) if (isSeen(surface, f)) for (let c = 3 * f; c < 3 * f + 3; ++c) visit(surface.vertexAt(c), f);
  };
  each((vertex) => ++first[vertex + 1]!);
  for (let v = 0; v < vertexCount; ++v) first[v + 1]! += first[v]!;
  const faces = new Uint32Array(first[vertexCount]!), next = first.slice(0, vertexCount);
  each((vertex, face) => (faces[next[vertex]!++] = face));
  return { first, faces };
}

/** Edges at each vertex that are seen, as the server counts them: each once, however many faces share it. O(faces). */
export function valences(surface: Surface): Uint32Array {
  const { vertexCount } = surface;
  const { first, faces } = cornersByVertex(surface);
  const count = new Uint32Array(vertexCount);
  /** The vertex from which a neighbour was met last, plus one. */
  const met = new Uint32Array(vertexCount);
  for (let v = 0; v < vertexCount; ++v) {
    for (let n = first[v]!; n < first[v + 1]!; ++n) {
      for (let c = 3 * faces[n]!; c < 3 * faces[n]! + 3; ++c) {
        const other = surface.vertexAt(c);
        if (other === v || met[other] === v + 1) continue;
        met[other] = v + 1;
        ++count[v]!;
      }
    }
  }
  return count;
}
