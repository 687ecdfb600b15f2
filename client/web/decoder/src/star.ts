import type { ProgressiveMesh } from "./mesh.js";

/**
 * A vertex and its ring, counter-clockwise from the nearest neighbour on (of several the one with the lowest number). Sums over it
 * are made in the order of the ring, so that they are the same bits as in C++.
 *
 * Numbers with a fraction are kept in arrays throughout: one that is handed to a function or given back by it may cost an object.
 */
export class Star {
  valence = 0;
  readonly centre = new Float64Array(3);
  /** Of each neighbour in the order in which the mesh is walked: its number, the centre's corner in the face after it, its offset from the centre. */
  private vertices = new Int32Array(64);
  private corners = new Int32Array(64);
  offsets = new Float64Array(3 * 64);
  /** Where in them the ring begins. */
  private first = 0;

  // How it lies; see StarFrame in C++. Here, codes say how far it reaches.
  /** The sums of the offsets from the first neighbour to the one `steps` after it, and from there on once around to the first. */
  readonly sums = new Float64Array(6);
  readonly normal = new Float64Array(3);
  across = 0;
  hasPlane = false;

  /** `start`: any corner at the vertex. */
  gather(mesh: ProgressiveMesh, vertex: number, start: number): void {
    const { positions, around } = mesh;
    const { centre } = this;
    let { vertices, corners, offsets } = this;
    const cx = positions[3 * vertex]!, cy = positions[3 * vertex + 1]!, cz = positions[3 * vertex + 2]!;
    let count = 0;
    let first = 0;
    let nearest = -1;
    let least = Infinity;
    let corner = start;
    do {
      if (count === corners.length) {
        this.grow();
        ({ vertices, corners, offsets } = this);
      }
      const neighbour = around[2 * corner]! | 0;
      corner = around[2 * corner + 1]! | 0;
      const at = (3 * neighbour) | 0, to = (3 * count) | 0;
      const dx = positions[at]! - cx, dy = positions[at + 1]! - cy, dz = positions[at + 2]! - cz;
      vertices[count] = neighbour;
      corners[count] = corner;
      offsets[to] = dx;
      offsets[to + 1] = dy;
      offsets[to + 2] = dz;
      const square = dx * dx + dy * dy + dz * dz;
      if (square < least || (square === least && neighbour < nearest)) {
        first = count;
        nearest = neighbour;
        least = square;
      }
      count = (count + 1) | 0;
    } while (corner !== start);
    this.valence = count;
    this.first = first;
    centre[0] = cx;
    centre[1] = cy;
    centre[2] = cz;
  }

  private grow(): void {
    const size = 2 * this.corners.length;
    const vertices = new Int32Array(size), corners = new Int32Array(size), offsets = new Float64Array(3 * size);
    vertices.set(this.vertices);
    corners.set(this.corners);
    offsets.set(this.offsets);
    Object.assign(this, { vertices, corners, offsets });
  }

  /** Begins the ring `steps` later, less than the valence. */
  turn(steps: number): void {
    this.first = this.slot(steps);
  }

  /** Where the n-th neighbour is in the arrays, n at most the valence. */
  slot(n: number): number {
    const at = this.first + n;
    return at >= this.valence ? at - this.valence : at;
  }

  vertex(n: number): number {
    return this.vertices[this.slot(n)]!;
  }

  corner(n: number): number {
    return this.corners[this.slot(n)]!;
  }

  /** `steps` is less than the valence. */
  lie(steps: number): void {
    const { offsets, sums, normal } = this;
    const valence = this.valence | 0;
    let from = this.first | 0, n = 0;
    let n0 = 0, n1 = 0, n2 = 0;
    let ax = offsets[3 * from]!, ay = offsets[3 * from + 1]!, az = offsets[3 * from + 2]!;
    for (let part = 0; part < 2; ++part) {
      const end = part === 0 ? steps : valence;
      let sx = 0, sy = 0, sz = 0;
      for (; n < end; ++n) {
        sx += ax;
        sy += ay;
        sz += az;
        from = from + 1 === valence ? 0 : (from + 1) | 0;
        const bx = offsets[3 * from]!, by = offsets[3 * from + 1]!, bz = offsets[3 * from + 2]!;
        n0 += ay * bz - az * by;
        n1 += az * bx - ax * bz;
        n2 += ax * by - ay * bx;
        ax = bx;
        ay = by;
        az = bz;
      }
      sums[3 * part] = sx + ax;
      sums[3 * part + 1] = sy + ay;
      sums[3 * part + 2] = sz + az;
    }
    normal[0] = n0;
    normal[1] = n1;
    normal[2] = n2;
    const a0 = Math.abs(n0), a1 = Math.abs(n1), a2 = Math.abs(n2);
    this.across = a2 > (a1 > a0 ? a1 : a0) ? 2 : a1 > a0 ? 1 : 0;
    this.hasPlane = normal[this.across] !== 0;
  }
}
