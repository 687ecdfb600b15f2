import type { RecordBlock } from "./block.js";
import { crc32c } from "./crc32c.js";
import { Encoding } from "./grid.js";
import { Kind } from "./mesh.js";

/** Why a file is refused, as core names it. */
export type FileFault = "UNKNOWN_FORMAT" | "UNSUPPORTED" | "TRUNCATED_INPUT" | "CORRUPT";

export class MrrFileError extends Error {
  override name = "MrrFileError";

  constructor(readonly fault: FileFault, byte: number, what: string) {
    super(`byte ${byte}: ${what}`);
  }
}

const mark = [0x89, 0x56, 0x53, 0x50, 0x0d, 0x0a, 0x1a, 0x0a];
const version = 1;
const headerBytes = 48;
const blockHeaderBytes = 20;
const regionsTag = [0x52, 0x45, 0x47, 0x4e];
/** Where the numbers of the header are. */
const enum At {
  Version = 8,
  Vertices = 12,
  Faces = 16,
  Ghosts = 20,
  Splits = 24,
  Records = 28,
  Shown = 32,
  Description = 36,
  BaseCrc = 40,
  HeaderCrc = 44,
}

const beginsWith = (bytes: Uint8Array, begin: readonly number[]): boolean => begin.every((byte, n) => bytes[n] === byte);

/** Whether bytes begin as a `.vsplit` file does. */
export const isMrrFile = (bytes: Uint8Array): boolean => beginsWith(bytes, mark);

/**
 * A `.vsplit` file (docs/format.md): its base mesh, and the blocks of records that lead from it to the finest level. The constructor
 * and `blocks` throw MrrFileError at the first byte that is at fault; no memory is taken for what a header merely announces.
 */
export class MrrFile {
  readonly base: { positions: Float64Array; corners: Uint32Array; ghosts: number };
  /** Faces of the level that its maker chose to show. */
  readonly shown: number;
  /** What its maker wrote about it; `vsplit` writes the JSON of a `vsplit.v1.Representation`. */
  readonly description: string;
  readonly records: number;
  private readonly splits: number;
  private readonly view: DataView;
  private readonly blocksAt: number;

  constructor(private readonly bytes: Uint8Array) {
    this.view = new DataView(bytes.buffer, bytes.byteOffset, bytes.length);
    this.checkHeader();
    this.splits = this.field(At.Splits);
    this.records = this.field(At.Records);
    this.shown = this.field(At.Shown);
    const descriptionAt = headerBytes + 24 * this.field(At.Vertices) + 12 * this.field(At.Faces);
    this.blocksAt = descriptionAt + this.field(At.Description);
    this.checkSizes();
    this.description = new TextDecoder().decode(bytes.subarray(descriptionAt, this.blocksAt));
    this.base = this.readBase();
  }

  /** All records in order, a block at a time. */
  *blocks(): Generator<RecordBlock, void> {
    let at = this.blocksAt, read = 0, last: number = Kind.Split;
    const cut = (): MrrFileError => new MrrFileError("TRUNCATED_INPUT", this.bytes.length, `the file ends after ${read} of ${this.records} records`);
    while (read < this.records) {
      if (this.bytes.length - at < blockHeaderBytes) throw cut();
      const [first, count, encoding, size, crc] = [0, 4, 8, 12, 16].map((n) => this.field(at + n)) as [number, number, number, number, number];
      const due = this.records - read;
      if (first !== read || count === 0 || count > due) {
        throw new MrrFileError("CORRUPT", at, `a block has records ${first} and on, ${count} in all, where up to ${due} from ${read} on are due`);
      }
      at += blockHeaderBytes;
      if (size > this.bytes.length - at) throw cut();
      const payload = this.bytes.subarray(at, at + size);
      yield { first, count, encoding, payload, crc32c: crc };
      at += size;
      read += count;
      if (encoding === Encoding.Float64) last = payload[count - 1]!;
    }
    if (last !== Kind.Split) throw new MrrFileError("CORRUPT", this.bytes.length, `the last of ${this.records} records is no split; edits stand before a split`);
    this.checkEnd(at);
  }

  /** That the records were as many splits as announced, once all are applied. */
  checkLevel(level: number): void {
    if (level !== this.splits) throw new MrrFileError("CORRUPT", At.Splits, `${level} of ${this.records} records are splits, not ${this.splits}`);
  }

  private field(at: number): number {
    return this.view.getUint32(at, true);
  }

  private checkHeader(): void {
    const { bytes } = this;
    if (!beginsWith(bytes, mark.slice(0, bytes.length))) throw new MrrFileError("UNKNOWN_FORMAT", 0, "this is no .vsplit file");
    if (bytes.length < headerBytes) throw new MrrFileError("TRUNCATED_INPUT", bytes.length, `the file ends within its header of ${headerBytes} bytes`);
    const has = this.field(At.Version);
    if (has > version) throw new MrrFileError("UNSUPPORTED", At.Version, `the file is of version ${has} of the format; this program reads version ${version}`);
    if (crc32c(bytes.subarray(0, At.HeaderCrc)) !== this.field(At.HeaderCrc)) throw new MrrFileError("CORRUPT", At.HeaderCrc, "the header's checksum does not fit it");
    if (has !== version) throw new MrrFileError("CORRUPT", At.Version, `there is no version ${has} of the format`);
  }

  private checkSizes(): void {
    const due = this.blocksAt - headerBytes, left = this.bytes.length - headerBytes;
    if (due > left) throw new MrrFileError("TRUNCATED_INPUT", headerBytes, `base mesh and description take ${due} bytes; the file has ${left} more`);
    if (3 * (this.field(At.Faces) + 2 * this.splits) >= 0xffffffff) throw new MrrFileError("CORRUPT", At.Splits, "the finest level would have more corners than 32 bits can number");
    if (this.splits > this.records) throw new MrrFileError("CORRUPT", At.Splits, `${this.splits} splits among ${this.records} records`);
    if (crc32c(this.bytes.subarray(headerBytes, this.blocksAt)) !== this.field(At.BaseCrc)) {
      throw new MrrFileError("CORRUPT", headerBytes, "the checksum of base mesh and description does not fit them");
    }
  }

  private readBase(): MrrFile["base"] {
    const positions = new Float64Array(3 * this.field(At.Vertices)), corners = new Uint32Array(3 * this.field(At.Faces));
    const cornersAt = headerBytes + 8 * positions.length;
    positions.forEach((_, n) => (positions[n] = this.view.getFloat64(headerBytes + 8 * n, true)));
    corners.forEach((_, n) => (corners[n] = this.field(cornersAt + 4 * n)));
    const ghosts = this.field(At.Ghosts);
    const fault = (what: string): MrrFileError => new MrrFileError("CORRUPT", headerBytes, `the base mesh: ${what}`);
    let seen = 0;
    for (let f = 0; f < corners.length / 3; ++f) {
      const touched = corners.subarray(3 * f, 3 * f + 3).filter((vertex) => vertex < ghosts).length;
      if (touched > 1) throw fault(`face ${f} joins two ghosts`);
      if (touched === 0) ++seen;
    }
    if (seen === 0) throw fault("no face of it is to be seen");
    return { positions, corners, ghosts };
  }

  /** The file ends with the last block, or the regions that follow it: those are of no use here, but must be whole. */
  private checkEnd(at: number): void {
    const rest = this.bytes.subarray(at);
    if (rest.length === 0) return;
    if (rest.length < 8 || !beginsWith(rest, regionsTag)) {
      throw new MrrFileError("CORRUPT", at, `${rest.length} bytes follow the last of ${this.records} records; expected nothing, or regions`);
    }
    if (crc32c(rest.subarray(8)) !== this.field(at + 4)) throw new MrrFileError("CORRUPT", at, "the checksum of the regions does not fit them");
  }
}
