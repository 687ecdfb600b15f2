import { next, prev, type ProgressiveMesh } from "./mesh.js";

/**
 * A vertex and its ring, counter-clockwise from the nearest neighbour on (of several the one with the lowest number). Sums over it
 * are made in the order of the ring, so that they are the same bits as in C++.
 */
export class Star {
  valence = 0;
  first = 0;
  cx = 0;
  cy = 0;
  cz = 0;
  corner = new Uint32Array(64);
  vertex = new Uint32Array(64);
  x = new Float64Array(64);
  y = new Float64Array(64);
  z = new Float64Array(64);

  // How it lies; see StarFrame in C++.
  across = 0;
  hasPlane = false;
  readonly normal = new Float64Array(3);
  readonly reach = new Float64Array(3);
  thickness = 0;

  gather(mesh: ProgressiveMesh, vertex: number): void {
    const { positions, corners, twins } = mesh;
    const start = mesh.cornerOf[vertex]!;
    const cx = (this.cx = positions[3 * vertex]!);
    const cy = (this.cy = positions[3 * vertex + 1]!);
    const cz = (this.cz = positions[3 * vertex + 2]!);
    let count = 0;
    let nearest = 0;
    let least = 0;
    let corner = start;
    do {
      if (count === this.corner.length) this.grow();
      const neighbour = corners[next(corner)]!;
      const dx = positions[3 * neighbour]! - cx;
      const dy = positions[3 * neighbour + 1]! - cy;
      const dz = positions[3 * neighbour + 2]! - cz;
      const square = dx * dx + dy * dy + dz * dz;
      if (count === 0 || square < least || (square === least && neighbour < this.vertex[nearest]!)) {
        nearest = count;
        least = square;
      }
      this.corner[count] = corner;
      this.vertex[count] = neighbour;
      this.x[count] = dx;
      this.y[count] = dy;
      this.z[count] = dz;
      ++count;
      corner = twins[prev(corner)]!;
    } while (corner !== start);
    this.valence = count;
    this.first = nearest;
  }

  private grow(): void {
    const size = 2 * this.corner.length;
    const uint = (from: Uint32Array) => {
      const to = new Uint32Array(size);
      to.set(from);
      return to;
    };
    const float = (from: Float64Array) => {
      const to = new Float64Array(size);
      to.set(from);
      return to;
    };
    this.corner = uint(this.corner);
    this.vertex = uint(this.vertex);
    this.x = float(this.x);
    this.y = float(this.y);
    this.z = float(this.z);
  }

  turn(steps: number): void {
    this.first = (this.first + steps) % this.valence;
  }

  /** Place in the arrays of spoke n from the first on; n may go once around. */
  at(n: number): number {
    const place = this.first + n;
    return place < this.valence ? place : place < 2 * this.valence ? place - this.valence : place - 2 * this.valence;
  }

  lie(): void {
    const { normal, reach, x, y, z, valence } = this;
    let n0 = 0, n1 = 0, n2 = 0, r0 = 0, r1 = 0, r2 = 0;
    for (let n = 0, a = this.at(0); n < valence; ++n) {
      const b = a + 1 === valence ? 0 : a + 1;
      const ax = x[a]!, ay = y[a]!, az = z[a]!, bx = x[b]!, by = y[b]!, bz = z[b]!;
      n0 += ay * bz - az * by;
      n1 += az * bx - ax * bz;
      n2 += ax * by - ay * bx;
      if (Math.abs(ax) > r0) r0 = Math.abs(ax);
      if (Math.abs(ay) > r1) r1 = Math.abs(ay);
      if (Math.abs(az) > r2) r2 = Math.abs(az);
      a = b;
    }
    normal[0] = n0;
    normal[1] = n1;
    normal[2] = n2;
    reach[0] = r0;
    reach[1] = r1;
    reach[2] = r2;
    this.across = 0;
    if (Math.abs(n1) > Math.abs(normal[this.across]!)) this.across = 1;
    if (Math.abs(n2) > Math.abs(normal[this.across]!)) this.across = 2;
    this.hasPlane = normal[this.across]! !== 0;
    this.thickness = 0;
    if (!this.hasPlane) return;
    let thickness = 0;
    for (let n = 0; n < valence; ++n) {
      const height = Math.abs(n0 * x[n]! + n1 * y[n]! + n2 * z[n]!);
      if (height > thickness) thickness = height;
    }
    this.thickness = thickness / Math.abs(normal[this.across]!);
  }

  height(dx: number, dy: number, dz: number): number {
    const { normal } = this;
    return (normal[0]! * dx + normal[1]! * dy + normal[2]! * dz) / normal[this.across]!;
  }
}
