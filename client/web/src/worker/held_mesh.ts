import { Encoding, float32Grid, float64Grid, ProgressiveMesh, RecordDecoder, unpackBase, crc32c, type Grid, type RecordBlock } from "../../decoder/src/index";
import type { BaseMesh } from "../gen/vsplit/v1/meshing_pb";

/** The mesh of a representation as far as records have come: taken up and down between its coarsest level and what is held. */
export class HeldMesh {
  readonly mesh: ProgressiveMesh;
  private readonly decoder: RecordDecoder;
  /** Numbers of the faces that touch a ghost, ascending: they never change, as ghosts are never split. */
  private readonly ghostFaces: number[] = [];
  private facesLooked = 0;
  private readonly baseFaces: number;

  /** `splits`: how many are announced. */
  constructor(base: { positions: Float64Array; corners: Uint32Array; ghosts: number }, grid: Grid, splits = 0) {
    this.mesh = new ProgressiveMesh(base.positions, base.corners, base.ghosts);
    this.mesh.foresee(splits);
    this.decoder = new RecordDecoder(grid);
    this.baseFaces = this.mesh.faceCount;
    this.mesh.follow();
    this.lookAtNewFaces();
  }

  take(block: RecordBlock): void {
    this.decoder.decode(block, this.mesh);
    this.lookAtNewFaces();
  }

  get recordsHeld(): number {
    return this.mesh.records + this.mesh.recordsUndone;
  }

  get visible(): number {
    return this.visibleOf(this.mesh.faceCount);
  }

  /** Seen at the coarsest level. */
  get visibleLeast(): number {
    return this.visibleOf(this.baseFaces);
  }

  /** Seen at the finest level that is held. */
  get visibleHeld(): number {
    return this.visibleOf(this.facesLooked);
  }

  /** To the finest held level of at most `faces` faces; the coarsest where there is none. */
  show(faces: number): void {
    let low = 0;
    let high = (this.facesLooked - this.baseFaces) / 2 + 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (this.visibleOf(this.baseFaces + 2 * middle) <= faces) low = middle;
      else high = middle;
    }
    if (low <= this.mesh.level) this.mesh.coarsen(this.mesh.level - low);
    else this.mesh.refine(low);
  }

  /** Faces that changed since it was asked last, ascending. */
  takeChanges(): Uint32Array {
    return this.mesh.takeChanges();
  }

  private lookAtNewFaces(): void {
    const { mesh } = this;
    const { ghosts, faceCount } = mesh;
    for (let f = this.facesLooked; f < faceCount; ++f) {
      if (Math.min(mesh.vertexAt(3 * f), mesh.vertexAt(3 * f + 1), mesh.vertexAt(3 * f + 2)) < ghosts) this.ghostFaces.push(f);
    }
    this.facesLooked = Math.max(this.facesLooked, faceCount);
  }

  private visibleOf(faceCount: number): number {
    let low = 0, high = this.ghostFaces.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.ghostFaces[middle]! < faceCount) low = middle + 1;
      else high = middle;
    }
    return faceCount - low;
  }
}

/** Puts the parts of a packed base mesh together. */
export class BaseParts {
  private bytes: Uint8Array | undefined;

  /** The mesh once the last part is there. Only packed base meshes: FLOAT32 and QUANTISED. */
  push(part: BaseMesh): HeldMesh | undefined {
    const encoding: Encoding = part.encoding as number;
    if (encoding === Encoding.Float64 || (part.encoding as number) === 0) throw new Error("the base mesh is not packed");
    if (part.packedOffset === 0) this.bytes = new Uint8Array(part.packedSize);
    if (!this.bytes || part.packedOffset + part.packed.length > this.bytes.length) throw new Error("a part of the base mesh is missing");
    this.bytes.set(part.packed, part.packedOffset);
    if (part.packedOffset + part.packed.length < this.bytes.length) return undefined;
    if (crc32c(this.bytes) !== part.packedCrc32c >>> 0) throw new Error("the CRC-32C does not fit the base mesh");
    const counts = { vertices: part.vertices, faces: part.faces, ghosts: part.ghosts };
    const grid = gridOf(part);
    return new HeldMesh({ ...unpackBase(this.bytes, counts, grid), ghosts: part.ghosts }, grid, part.splits);
  }
}

function gridOf(part: BaseMesh): Grid {
  const encoding: Encoding = part.encoding as number;
  if (encoding === Encoding.Float32) return float32Grid;
  if (encoding === Encoding.Float64) return float64Grid;
  const { x, y, z } = part.origin ?? { x: 0, y: 0, z: 0 };
  return { encoding, bits: part.quantisationBits, origin: [x, y, z], step: part.step };
}
