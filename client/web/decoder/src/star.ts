import { next, prev, type ProgressiveMesh } from "./mesh.js";

/**
 * A vertex and its ring, counter-clockwise from the nearest neighbour on (of several the one with the lowest number). Sums over it
 * are made in the order of the ring, so that they are the same bits as in C++.
 */
export class Star {
  valence = 0;
  /** Where in the arrays the ring begins. They hold it twice, one after the other, so that it goes on from there without a turn. */
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
    let first = 0;
    let nearest = 0xffffffff;
    let least = Infinity;
    let corner = start;
    do {
      if (2 * count + 2 > this.corner.length) this.grow();
      const neighbour = corners[next(corner)]!;
      const dx = positions[3 * neighbour]! - cx;
      const dy = positions[3 * neighbour + 1]! - cy;
      const dz = positions[3 * neighbour + 2]! - cz;
      const square = dx * dx + dy * dy + dz * dz;
      if (square < least || (square === least && neighbour < nearest)) {
        first = count;
        nearest = neighbour;
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
    for (let n = 0; n < count; ++n) {
      this.corner[count + n] = this.corner[n]!;
      this.vertex[count + n] = this.vertex[n]!;
      this.x[count + n] = this.x[n]!;
      this.y[count + n] = this.y[n]!;
      this.z[count + n] = this.z[n]!;
    }
    this.valence = count;
    this.first = first;
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

  /** `steps` is less than the valence. */
  turn(steps: number): void {
    this.first += steps;
    if (this.first >= this.valence) this.first -= this.valence;
  }

  lie(): void {
    const { normal, reach, x, y, z, valence, first } = this;
    let n0 = 0, n1 = 0, n2 = 0, r0 = 0, r1 = 0, r2 = 0;
    let ax = x[first]!, ay = y[first]!, az = z[first]!;
    for (let b = first + 1; b <= first + valence; ++b) {
      const bx = x[b]!, by = y[b]!, bz = z[b]!;
      n0 += ay * bz - az * by;
      n1 += az * bx - ax * bz;
      n2 += ax * by - ay * bx;
      if (Math.abs(ax) > r0) r0 = Math.abs(ax);
      if (Math.abs(ay) > r1) r1 = Math.abs(ay);
      if (Math.abs(az) > r2) r2 = Math.abs(az);
      ax = bx;
      ay = by;
      az = bz;
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
