import { sharedEngine } from "./engine.js";
import type { Grid } from "./grid.js";
import type { ProgressiveMesh } from "./mesh.js";

/** A `vsplit.v1.RecordBlock`. */
export interface RecordBlock {
  first: number;
  count: number;
  encoding: number;
  payload: Uint8Array;
  crc32c: number;
}

/** Decodes the blocks of a stream onto a mesh, one after the other. */
export class RecordDecoder {
  /** Throws CorruptError for a grid that no stream can have. */
  constructor(readonly grid: Grid) {
    sharedEngine().setGrid(grid);
  }

  /**
   * `mesh` stands where the block begins, records that were undone counted in, and takes its records.
   * Throws CorruptError that names the block by its first record; the mesh then is as it was, with none undone.
   */
  decode(block: RecordBlock, mesh: ProgressiveMesh): void {
    mesh.append(block, this.grid);
  }
}
