import type { Ramp } from "../shared/colours";
import type { Patch, Point } from "../shared/protocol";
import { Extent } from "./extent";
import { FaceShape, isSeen, valences, type Surface } from "./surface";

/** Runs closer to each other than this are drawn as one: a call costs more than some faces. */
const gap = 32;
/** From this share of all faces on everything is drawn anew. */
const most = 0.5;

type Painted = Pick<Patch, "runs" | "positions" | "colours" | "sizes">;

/** Makes what is drawn out of faces. */
export class Painter {
  private valence: Uint32Array = new Uint32Array(0);
  private readonly shape = new FaceShape();
  private sizes = new Extent();

  constructor(private readonly centre: Point, public ramp: Ramp) {}

  whole(surface: Surface): Painted {
    return this.paint(surface, surface.faceCount > 0 ? [0, surface.faceCount] : []);
  }

  /** `faces` in ascending order. */
  some(surface: Surface, faces: Uint32Array): Painted {
    if (faces.length > most * surface.faceCount) return this.whole(surface);
    const runs: number[] = [];
    for (const face of faces) {
      const last = runs.length - 2;
      if (last >= 0 && face <= runs[last]! + runs[last + 1]! + gap) runs[last + 1] = face + 1 - runs[last]!;
      else runs.push(face, 1);
    }
    return this.paint(surface, runs);
  }

  private paint(surface: Surface, runs: number[]): Painted {
    if (this.ramp.by === "valence") this.valence = valences(surface);
    this.sizes = new Extent();
    let faces = 0;
    for (let n = 1; n < runs.length; n += 2) faces += runs[n]!;
    const positions = new Float32Array(9 * faces);
    const colours = new Uint8Array(9 * faces);
    let at = 0;
    for (let n = 0; n < runs.length; n += 2) {
      for (let face = runs[n]!; face < runs[n]! + runs[n + 1]!; ++face, at += 9) {
        if (isSeen(surface, face)) this.paintFace(surface, face, positions, colours, at);
      }
    }
    return { runs: Uint32Array.from(runs), positions, colours, sizes: this.sizes.range };
  }

  private paintFace(surface: Surface, face: number, positions: Float32Array, colours: Uint8Array, at: number): void {
    const { positions: from } = surface;
    this.shape.measure(surface, face);
    const { size, stretch } = this.shape;
    this.sizes.add(size);
    const { by } = this.ramp;
    const value = by === "size" ? size : stretch;
    for (let c = 0; c < 3; ++c) {
      const vertex = surface.vertexAt(3 * face + c);
      for (let axis = 0; axis < 3; ++axis) positions[at + 3 * c + axis] = from[3 * vertex + axis]! - this.centre[axis]!;
      this.ramp.put(by === "valence" ? this.valence[vertex]! : value, colours, at + 3 * c);
    }
  }
}
