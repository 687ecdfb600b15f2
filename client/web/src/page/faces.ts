import { BufferAttribute, BufferGeometry, Mesh, Vector3, type Material } from "three";
import type { Patch } from "../shared/protocol";

const room = 1.3;

/** Faces on the graphics card; patches write into the buffers where something changed. */
export class Faces {
  readonly mesh: Mesh;
  private positions = new BufferAttribute(new Float32Array(0), 3);
  private colours = new BufferAttribute(new Uint8Array(0), 3, true);
  visible = 0;

  constructor(material: Material) {
    this.mesh = new Mesh(new BufferGeometry(), material);
    this.mesh.frustumCulled = false;
    this.mesh.visible = false;
  }

  apply(patch: Patch): void {
    if (9 * patch.slots > this.positions.array.length) this.grow(patch.slots);
    let from = 0;
    for (let n = 0; n < patch.runs.length; n += 2) {
      const first = 9 * patch.runs[n]!, size = 9 * patch.runs[n + 1]!;
      (this.positions.array as Float32Array).set(patch.positions.subarray(from, from + size), first);
      (this.colours.array as Uint8Array).set(patch.colours.subarray(from, from + size), first);
      this.positions.addUpdateRange(first, size);
      this.colours.addUpdateRange(first, size);
      from += size;
    }
    if (patch.runs.length > 0) {
      this.positions.needsUpdate = true;
      this.colours.needsUpdate = true;
    }
    this.mesh.geometry.setDrawRange(0, 3 * patch.slots);
    this.mesh.visible = true;
    this.visible = patch.visible;
  }

  /** The normal of the face whose middle is nearest to a point: where to look at it from. O(faces). */
  normalAt(point: Vector3): Vector3 | undefined {
    const p = this.positions.array, end = 3 * this.mesh.geometry.drawRange.count;
    let best = -1, least = Infinity;
    for (let at = 0; at < end; at += 9) {
      const x = (p[at]! + p[at + 3]! + p[at + 6]!) / 3 - point.x;
      const y = (p[at + 1]! + p[at + 4]! + p[at + 7]!) / 3 - point.y;
      const z = (p[at + 2]! + p[at + 5]! + p[at + 8]!) / 3 - point.z;
      const square = x * x + y * y + z * z;
      if (square < least) {
        least = square;
        best = at;
      }
    }
    if (best < 0) return undefined;
    const [a, b, c] = [0, 3, 6].map((corner) => new Vector3(p[best + corner], p[best + corner + 1], p[best + corner + 2])) as [Vector3, Vector3, Vector3];
    const normal = b.sub(a).cross(c.sub(a));
    return normal.lengthSq() > 0 ? normal.normalize() : undefined;
  }

  /** Buffers of another size are other buffers: what was in them comes along. */
  private grow(slots: number): void {
    const floats = 9 * Math.ceil(slots * room);
    const positions = new Float32Array(floats), colours = new Uint8Array(floats);
    positions.set(this.positions.array as Float32Array);
    colours.set(this.colours.array as Uint8Array);
    this.positions = new BufferAttribute(positions, 3);
    this.colours = new BufferAttribute(colours, 3, true);
    for (const attribute of [this.positions, this.colours]) attribute.onUpload(() => attribute.clearUpdateRanges());
    this.mesh.geometry.dispose();
    this.mesh.geometry = new BufferGeometry();
    this.mesh.geometry.setAttribute("position", this.positions);
    this.mesh.geometry.setAttribute("color", this.colours);
  }
}
