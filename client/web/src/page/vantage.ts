import { Triangle, Vector3 } from "three";

/** Faces as they are drawn: nine floats each; `floats` of them count. */
export interface Drawn {
  positions: Float32Array;
  floats: number;
}

/** Where to look at a place from. */
export interface Vantage {
  /** From the place to the eye, of length 1. */
  away: Vector3;
  /** Whether nothing stands between them. */
  free: boolean;
}

const triangle = new Triangle();
const nearest = new Vector3();

function* facesNear({ positions: p, floats }: Drawn, place: Vector3, reach: number): Generator<number> {
  for (let at = 0; at < floats; at += 9) {
    let near = true;
    for (let axis = 0; near && axis < 3; ++axis) {
      const a = p[at + axis]!, b = p[at + 3 + axis]!, c = p[at + 6 + axis]!, x = place.getComponent(axis);
      near = Math.max(a, b, c) >= x - reach && Math.min(a, b, c) <= x + reach;
    }
    if (near) yield at;
  }
}

function faceAt({ positions }: Drawn, at: number): Triangle {
  triangle.a.fromArray(positions, at);
  triangle.b.fromArray(positions, at + 3);
  triangle.c.fromArray(positions, at + 6);
  return triangle;
}

/** Longest edge of the smallest face at a place; undefined where there is none within `reach`. O(faces). */
export function sizeAt(drawn: Drawn, place: Vector3, reach: number): number | undefined {
  let size: number | undefined, least = reach;
  for (const at of facesNear(drawn, place, reach)) {
    const { a, b, c } = faceAt(drawn, at);
    const distance = triangle.closestPointToPoint(place, nearest).distanceTo(place);
    const longest = Math.max(a.distanceTo(b), b.distanceTo(c), c.distanceTo(a));
    if (distance > least + 1e-4 * reach) continue;
    size = distance < least - 1e-4 * reach || size === undefined ? longest : Math.min(size, longest);
    least = Math.min(least, distance);
  }
  return size;
}

/**
 * The direction that most of the surface around a place faces, up to its sign, which is that of the outside where there is one: of a
 * thin plate, whose rim the place may be on, across the plate. By power iteration on the sum of n n^T over faces within `reach`.
 */
function facing(drawn: Drawn, place: Vector3, reach: number): Vector3 | undefined {
  const sum = new Vector3(), normal = new Vector3();
  let [xx, xy, xz, yy, yz, zz] = [0, 0, 0, 0, 0, 0];
  for (const at of facesNear(drawn, place, reach)) {
    const face = faceAt(drawn, at);
    if (face.closestPointToPoint(place, nearest).distanceTo(place) > reach) continue;
    const weight = Math.min(face.getArea(), reach * reach);
    const { x, y, z } = face.getNormal(normal);
    xx += weight * x * x;
    xy += weight * x * y;
    xz += weight * x * z;
    yy += weight * y * y;
    yz += weight * y * z;
    zz += weight * z * z;
    sum.addScaledVector(normal, weight);
  }
  if (xx + yy + zz === 0) return undefined;
  // Not quite along an axis, lest the start be across what is looked for.
  const found = new Vector3(0.83, 0.45, 0.33);
  for (let n = 0; n < 50; ++n) {
    const { x, y, z } = found;
    found.set(xx * x + xy * y + xz * z, xy * x + yy * y + yz * z, xz * x + yz * y + zz * z).normalize();
  }
  return found.dot(sum) < 0 ? found.negate() : found;
}

/** Whether a ray from a place meets a face between `from` and `to` of its length. O(faces). */
function meets({ positions: p, floats }: Drawn, { x: ox, y: oy, z: oz }: Vector3, { x: dx, y: dy, z: dz }: Vector3, from: number, to: number): boolean {
  for (let at = 0; at < floats; at += 9) {
    const ax = p[at]!, ay = p[at + 1]!, az = p[at + 2]!;
    const ux = p[at + 3]! - ax, uy = p[at + 4]! - ay, uz = p[at + 5]! - az;
    const vx = p[at + 6]! - ax, vy = p[at + 7]! - ay, vz = p[at + 8]! - az;
    const px = dy * vz - dz * vy, py = dz * vx - dx * vz, pz = dx * vy - dy * vx;
    const det = ux * px + uy * py + uz * pz;
    if (det === 0) continue;
    const sx = ox - ax, sy = oy - ay, sz = oz - az;
    const u = (sx * px + sy * py + sz * pz) / det;
    if (u < 0 || u > 1) continue;
    const qx = sy * uz - sz * uy, qy = sz * ux - sx * uz, qz = sx * uy - sy * ux;
    const v = (dx * qx + dy * qy + dz * qz) / det;
    if (v < 0 || u + v > 1) continue;
    const t = (vx * qx + vy * qy + vz * qz) / det;
    if (t > from && t < to) return true;
  }
  return false;
}

const axes = [0, 1, 2].flatMap((axis) => [1, -1].map((sign) => new Vector3().setComponent(axis, sign)));

/** The normal of the face whose middle is nearest to a place; undefined where it has next to no area. O(faces). */
export function normalOfFaceAt(drawn: Drawn, { x, y, z }: Vector3): Vector3 | undefined {
  const p = drawn.positions;
  let best = -1, least = Infinity;
  for (let at = 0; at < drawn.floats; at += 9) {
    const dx = (p[at]! + p[at + 3]! + p[at + 6]!) / 3 - x, dy = (p[at + 1]! + p[at + 4]! + p[at + 7]!) / 3 - y, dz = (p[at + 2]! + p[at + 5]! + p[at + 8]!) / 3 - z;
    const square = dx * dx + dy * dy + dz * dz;
    if (square >= least) continue;
    least = square;
    best = at;
  }
  if (best < 0) return undefined;
  const { a, b, c } = faceAt(drawn, best);
  const longest = Math.max(a.distanceTo(b), b.distanceTo(c), c.distanceTo(a));
  return triangle.getArea() > 1e-4 * longest * longest ? triangle.getNormal(new Vector3()) : undefined;
}

/**
 * Where to look at a place from, at a distance: at `face`, the normal of what is to be seen, where that is given, else across the
 * surface that is within `reach` of it; as near to where the eye is `now` as that allows, and so that nothing stands between, where
 * there is such a way. O(faces).
 */
export function vantage(drawn: Drawn, place: Vector3, reach: number, distance: number, now: Vector3, face?: Vector3): Vantage {
  const across = facing(drawn, place, reach) ?? now;
  // Not quite along the normal: from there a surface looks flat.
  const leaned = (direction: Vector3): Vector3 => now.clone().multiplyScalar(0.45).addScaledVector(direction, now.dot(direction) < -0.9 ? 2 : 1).normalize();
  const back = across.clone().negate();
  const ways = [...(face ? [leaned(face), face] : []), leaned(across), across, leaned(back), back, now, ...axes].map((way) => way.clone().normalize());
  const away = ways.find((way) => !meets(drawn, place, way, 0.05 * reach, distance));
  return { away: away ?? ways[0]!, free: away !== undefined };
}
