import { BufferAttribute, BufferGeometry, Mesh, type Material } from "three";
import type { Patch } from "../shared/protocol";
import type { Drawn } from "./vantage";

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
    this.mesh.geometry.setDrawRange(0, 0);
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

  get drawn(): Drawn {
    return { positions: this.positions.array as Float32Array, floats: 3 * this.mesh.geometry.drawRange.count };
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
