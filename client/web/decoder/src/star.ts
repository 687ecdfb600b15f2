import { next, prev, type ProgressiveMesh } from "./mesh.js";

/**
 * A vertex and its ring, counter-clockwise from the nearest neighbour on (of several the one with the lowest number). Sums over it
 * are made in the order of the ring, so that they are the same bits as in C++.
 */
export class Star {
  valence = 0;
  /** Where in `corner` and `vertex` the ring begins. */
  first = 0;
  cx = 0;
  cy = 0;
  cz = 0;
  corner = new Int32Array(64);
  vertex = new Int32Array(64);
  private offset = new Float64Array(3 * 64);
  /** Offsets of the neighbours as `lie` lays them out: from the first one on, once around and back to it. */
  x = new Float64Array(65);
  y = new Float64Array(65);
  z = new Float64Array(65);

  // How it lies; see StarFrame in C++.
  across = 0;
  hasPlane = false;
  readonly normal = new Float64Array(3);
  readonly reach = new Float64Array(3);
  thickness = 0;

  gather(mesh: ProgressiveMesh, vertex: number): void {
    const { positions, corners, twins } = mesh;
    let ring = this.corner, neighbours = this.vertex, offset = this.offset;
    const start = mesh.cornerOf[vertex]! | 0;
    const cx = positions[3 * vertex]!, cy = positions[3 * vertex + 1]!, cz = positions[3 * vertex + 2]!;
    let count = 0;
    let first = 0;
    let nearest = -1;
    let least = Infinity;
    let corner = start;
    do {
      if (count === ring.length) {
        this.grow();
        ring = this.corner;
        neighbours = this.vertex;
        offset = this.offset;
      }
      const neighbour = corners[next(corner)]! | 0;
      const at = (3 * neighbour) | 0, to = (3 * count) | 0;
      const dx = positions[at]! - cx, dy = positions[at + 1]! - cy, dz = positions[at + 2]! - cz;
      offset[to] = dx;
      offset[to + 1] = dy;
      offset[to + 2] = dz;
      ring[count] = corner;
      neighbours[count] = neighbour;
      const square = dx * dx + dy * dy + dz * dz;
      if (square < least || (square === least && neighbour < nearest)) {
        first = count;
        nearest = neighbour;
        least = square;
      }
      count = (count + 1) | 0;
      corner = twins[prev(corner)]! | 0;
    } while (corner !== start);
    this.valence = count;
    this.first = first;
    this.cx = cx;
    this.cy = cy;
    this.cz = cz;
  }

  private grow(): void {
    const size = 2 * this.corner.length;
    const corner = new Int32Array(size), vertex = new Int32Array(size), offset = new Float64Array(3 * size);
    corner.set(this.corner);
    vertex.set(this.vertex);
    offset.set(this.offset);
    this.corner = corner;
    this.vertex = vertex;
    this.offset = offset;
    this.x = new Float64Array(size + 1);
    this.y = new Float64Array(size + 1);
    this.z = new Float64Array(size + 1);
  }

  /** `steps` is less than the valence. */
  turn(steps: number): void {
    this.first += steps;
    if (this.first >= this.valence) this.first -= this.valence;
  }

  lie(): void {
    const { normal, reach, x, y, z, valence, offset } = this;
    let n0 = 0, n1 = 0, n2 = 0, r0 = 0, r1 = 0, r2 = 0;
    let from = this.first | 0;
    let ax = offset[3 * from]!, ay = offset[3 * from + 1]!, az = offset[3 * from + 2]!;
    for (let n = 0; n < valence; ++n) {
      x[n] = ax;
      y[n] = ay;
      z[n] = az;
      from = from + 1 === valence ? 0 : (from + 1) | 0;
      const bx = offset[3 * from]!, by = offset[3 * from + 1]!, bz = offset[3 * from + 2]!;
      n0 += ay * bz - az * by;
      n1 += az * bx - ax * bz;
      n2 += ax * by - ay * bx;
      r0 = Math.max(r0, Math.abs(ax));
      r1 = Math.max(r1, Math.abs(ay));
      r2 = Math.max(r2, Math.abs(az));
      ax = bx;
      ay = by;
      az = bz;
    }
    x[valence] = ax;
    y[valence] = ay;
    z[valence] = az;
    normal[0] = n0;
    normal[1] = n1;
    normal[2] = n2;
    reach[0] = r0;
    reach[1] = r1;
    reach[2] = r2;
    const a0 = Math.abs(n0), a1 = Math.abs(n1), a2 = Math.abs(n2);
    const across = a2 > (a1 > a0 ? a1 : a0) ? 2 : a1 > a0 ? 1 : 0;
    this.across = across;
    const steep = across === 0 ? a0 : across === 1 ? a1 : a2;
    this.hasPlane = steep !== 0;
    this.thickness = 0;
    if (!this.hasPlane) return;
    let thickness = 0;
    for (let n = 0; n < valence; ++n) thickness = Math.max(thickness, Math.abs(n0 * x[n]! + n1 * y[n]! + n2 * z[n]!));
    this.thickness = thickness / steep;
  }

  height(dx: number, dy: number, dz: number): number {
    const { normal } = this;
    return (normal[0]! * dx + normal[1]! * dy + normal[2]! * dz) / normal[this.across]!;
  }
}
