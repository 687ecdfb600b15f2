import { Engine } from "./engine.js";
import type { Grid } from "./grid.js";

/** What a stream's base mesh announces. */
export interface BaseCounts {
  vertices: number;
  faces: number;
  ghosts: number;
}

export interface BaseMesh {
  positions: Float64Array;
  corners: Uint32Array;
}

/** A packed base mesh, as FLOAT32 and QUANTISED have it. Throws CorruptError. */
export function unpackBase(bytes: Uint8Array, { vertices, faces, ghosts }: BaseCounts, grid: Grid): BaseMesh {
  const engine = new Engine();
  engine.setGrid(grid);
  engine.unpackBase(bytes, vertices, faces, ghosts);
  return { positions: engine.positions.slice(), corners: engine.corners.slice() };
}
