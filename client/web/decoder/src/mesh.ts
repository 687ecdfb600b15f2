import type { RecordBlock } from "./block.js";
import { Engine } from "./engine.js";
import type { Grid } from "./grid.js";

/**
 * A mesh that records are applied to and undone on: core's ProgressiveMesh, with the records that have come. Corner 3f + c is the c-th of
 * face f. Its memory is given back when nobody knows it any more, by itself. Where no memory is left, whatever changes it throws RangeError,
 * and it is of no use from then on.
 */
export class ProgressiveMesh {
  vertexCount = 0;
  faceCount = 0;
  /** x, y and z of each vertex: of the mesh's own memory, to be read until the mesh changes, which makes it another. */
  positions: Float64Array = new Float64Array();
  level = 0;
  /** Records applied. */
  records = 0;
  /** Records that `coarsen` undid. */
  recordsUndone = 0;

  private readonly engine = new Engine();
  private vertices: Uint32Array = new Uint32Array();

  /** Copies the arrays. Throws CorruptError where the mesh is not closed and manifold, or a ghost is where none may be. */
  constructor(positions: Float64Array, corners: Uint32Array, readonly ghosts = 0) {
    this.engine.begin(positions, corners, ghosts);
    this.look();
  }

  /** The vertex at a corner. */
  vertexAt(corner: number): number {
    return this.vertices[corner]!;
  }

  /** The vertices at all corners, as a new array. */
  corners(): Uint32Array {
    return this.vertices.slice();
  }

  /**
   * Makes room for splits that a file or a stream announces, as far as they are at most 64 times as many as there are vertices: what
   * is merely announced is no reason to take much memory.
   */
  foresee(splits: number): void {
    this.change((engine) => engine.call((to) => to.foresee(splits)));
  }

  /** For RecordDecoder. */
  append({ first, count, encoding, crc32c, payload }: RecordBlock, grid: Grid): void {
    this.change((engine) => {
      engine.setGrid(grid);
      engine.append(first, count, encoding, crc32c, payload);
    });
  }

  /** Undoes records until `records` are left, for good. */
  rewind(records: number): void {
    this.change((engine) => engine.call((to) => to.rewind(records)));
  }

  /** Undoes the edits after the last split, then `levels` splits, each with the edits before it. They are kept for `refine`. */
  coarsen(levels: number): void {
    this.change((engine) => engine.call((to) => to.coarsen(levels)));
  }

  /** Applies records that `coarsen` undid, up to the split that makes `level`; all where there are none so far. */
  refine(level: number): void {
    this.change((engine) => engine.call((to) => to.refine(level)));
  }

  /** Applies all that `coarsen` undid. */
  refineAll(): void {
    this.refine(0xffffffff);
  }

  /** From now on what changes is noted, for `takeChanges`. */
  follow(): void {
    this.engine.call((to) => to.follow());
  }

  /** Faces with a vertex that moved or whose ring changed since it was asked last, ascending, as a new array. */
  takeChanges(): Uint32Array {
    this.engine.call((to) => to.changes());
    const changes = this.engine.changes.slice();
    this.look();
    return changes;
  }

  /** The mesh without ghosts, as new arrays. */
  visible(): { positions: Float64Array; indices: Uint32Array } {
    const { ghosts, vertices } = this;
    const positions = this.positions.slice(3 * ghosts);
    if (ghosts === 0) return { positions, indices: this.corners() };
    const indices: number[] = [];
    for (let h = 0; h < vertices.length; h += 3) {
      const a = vertices[h]!, b = vertices[h + 1]!, c = vertices[h + 2]!;
      if (Math.min(a, b, c) >= ghosts) indices.push(a - ghosts, b - ghosts, c - ghosts);
    }
    return { positions, indices: Uint32Array.from(indices) };
  }

  /** Whatever may change the mesh, or take memory: views of that end when there is more of it. */
  private change(how: (engine: Engine) => void): void {
    try {
      how(this.engine);
    } finally {
      this.look();
    }
  }

  private look(): void {
    const { engine } = this;
    this.vertexCount = engine.vertices;
    this.faceCount = engine.faces;
    this.positions = engine.positions;
    this.vertices = engine.corners;
    this.level = engine.level;
    this.records = engine.records;
    this.recordsUndone = engine.undone;
  }
}
