import { unpackBase, type BaseMesh } from "./base.js";
import type { RecordBlock } from "./block.js";
import { crc32c } from "./crc32c.js";
import { Encoding, float64Grid, type Grid } from "./grid.js";

/** Why a file is refused, as core names it. */
export type FileFault = "UNKNOWN_FORMAT" | "UNSUPPORTED" | "TRUNCATED_INPUT" | "CORRUPT";

export class MrrFileError extends Error {
  override name = "MrrFileError";

  constructor(readonly fault: FileFault, byte: number, what: string) {
    super(`byte ${byte}: ${what}`);
  }
}

/** The kind of a record that is a split. */
const split = 0;
const mark = [0x89, 0x56, 0x53, 0x50, 0x0d, 0x0a, 0x1a, 0x0a];
const newest = 3;
const regionsTag = [0x52, 0x45, 0x47, 0x4e];

/** Where the numbers of the header are that all versions have. */
const enum At {
  Version = 8,
  Vertices = 12,
  Faces = 16,
  Ghosts = 20,
  Splits = 24,
  Records = 28,
  Shown = 32,
  Description = 36,
}

const enum At1 {
  BaseCrc = 40,
  HeaderCrc = 44,
  End = 48,
}
const blockHeaderBytes = 20;

const enum At2 {
  Blocks = 40,
  Encoding = 44,
  Bits = 48,
  Unit = 52,
  BaseBytes = 56,
  Origin = 64,
  Step = 88,
  MaxError = 96,
  BaseDeviation = 104,
  Source = 160,
  FileBytes = 192,
  BodyCrc = 200,
  HeaderCrc = 204,
  End = 208,
}
const indexBytes = 40;
const units = [undefined, "um", "mm", "cm", "m", "in", "ft"] as const;

/** The sections of a file, from byte to byte. */
interface Sections {
  base: [from: number, to: number];
  description: [from: number, to: number];
  /** From version 2 on. */
  index: [from: number, to: number];
  blocks: number;
}

/** An entry of the block index. */
export interface BlockEntry {
  first: number;
  count: number;
  /** Splits and visible faces at its end. */
  splits: number;
  faces: number;
  /** How far that level and the source are apart at most; NaN where nobody measured. */
  deviation: number;
  /** Where its payload is in the file. */
  offset: number;
  bytes: number;
  crc32c: number;
}

const beginsWith = (bytes: Uint8Array, begin: readonly number[]): boolean => begin.every((byte, n) => bytes[n] === byte);

/** Whether bytes begin as a `.vsplit` file does. */
export const isMrrFile = (bytes: Uint8Array): boolean => beginsWith(bytes, mark);

/**
 * A `.vsplit` file of any version (docs/format.md): its base mesh, and the blocks of records that lead from it to the finest level. The
 * constructor and `blocks` throw MrrFileError at the first byte that is at fault; no memory is taken for what a header merely announces.
 */
export class MrrFile {
  readonly base: { positions: Float64Array; corners: Uint32Array; ghosts: number };
  /** That its positions are on: what its RecordDecoder is made for. */
  readonly grid: Grid;
  /** Faces of the level that its maker chose to show. */
  readonly shown: number;
  /** What its maker wrote about it; `vsplit` writes the JSON of a `vsplit.v1.Representation`. */
  readonly description: string;
  readonly records: number;
  /** No coordinate was rounded by more than this. */
  readonly maxError: number = 0;
  /** Of all lengths; undefined where that is not known. */
  readonly unit: (typeof units)[number];
  /** SHA-256 of the file it was made from, in hexadecimal digits; undefined where that is not known. */
  readonly source: string | undefined;
  /** How far the base mesh and the source are apart at most; NaN where nobody measured. */
  readonly baseDeviation: number = NaN;
  /** Of the blocks; empty in version 1. */
  readonly index: readonly BlockEntry[] = [];
  private readonly version: number;
  /** Of which so many are splits. */
  readonly splits: number;
  private readonly view: DataView;
  private readonly sections: Sections;

  constructor(private readonly bytes: Uint8Array) {
    this.view = new DataView(bytes.buffer, bytes.byteOffset, bytes.length);
    this.version = this.checkVersion();
    this.checkHeader();
    this.splits = this.field(At.Splits);
    this.records = this.field(At.Records);
    this.shown = this.field(At.Shown);
    this.grid = this.version === 1 ? float64Grid : this.readGrid();
    this.sections = this.findSections();
    this.checkSizes();
    this.description = new TextDecoder().decode(bytes.subarray(...this.sections.description));
    if (this.version > 1) {
      this.unit = this.readUnit();
      this.maxError = this.length(At2.MaxError, false);
      this.baseDeviation = this.length(At2.BaseDeviation, true);
      const hash = bytes.subarray(At2.Source, At2.Source + 32);
      if (hash.some((byte) => byte !== 0)) this.source = Array.from(hash, (byte) => byte.toString(16).padStart(2, "0")).join("");
      this.index = this.readIndex();
    }
    this.base = this.readBase();
  }

  /** All records in order, a block at a time. */
  *blocks(): Generator<RecordBlock, void> {
    let last = split, end = this.sections.blocks;
    for (const { first, count, encoding, offset, bytes, crc32c } of this.places()) {
      const payload = this.bytes.subarray(offset, offset + bytes);
      yield { first, count, encoding, payload, crc32c };
      end = offset + bytes;
      if (encoding === Encoding.Float64) last = payload[count - 1]!;
    }
    if (last !== split) throw new MrrFileError("CORRUPT", end, `the last of ${this.records} records is no split; edits stand before a split`);
    this.checkEnd(end);
  }

  /** That the records were as many splits as announced, once all are applied. */
  checkLevel(level: number): void {
    if (level !== this.splits) throw new MrrFileError("CORRUPT", At.Splits, `${level} of ${this.records} records are splits, not ${this.splits}`);
  }

  private field(at: number): number {
    return this.view.getUint32(at, true);
  }

  private double(at: number): number {
    return this.view.getFloat64(at, true);
  }

  /** Sizes beyond what a file can have come out as too large to be there. */
  private size(at: number): number {
    return this.field(at) + 2 ** 32 * this.field(at + 4);
  }

  private length(at: number, mayBeUnknown: boolean): number {
    const value = this.double(at);
    if ((value >= 0 && value < Infinity) || (mayBeUnknown && Number.isNaN(value))) return value;
    throw new MrrFileError("CORRUPT", at, "an error or a deviation is no length");
  }

  private checkVersion(): number {
    const { bytes } = this;
    if (!beginsWith(bytes, mark.slice(0, bytes.length))) throw new MrrFileError("UNKNOWN_FORMAT", 0, "this is no .vsplit file");
    if (bytes.length < At.Version + 4) throw new MrrFileError("TRUNCATED_INPUT", bytes.length, "the file ends within its header");
    const version = this.field(At.Version);
    if (version > newest) throw new MrrFileError("UNSUPPORTED", At.Version, `the file is of version ${version} of the format; this program reads versions 1 to ${newest}`);
    if (version === 0) throw new MrrFileError("CORRUPT", At.Version, "there is no version 0 of the format");
    return version;
  }

  private checkHeader(): void {
    const { bytes } = this;
    const [end, crcAt] = this.version === 1 ? [At1.End, At1.HeaderCrc] : [At2.End, At2.HeaderCrc];
    if (bytes.length < end) throw new MrrFileError("TRUNCATED_INPUT", bytes.length, `the file ends within its header of ${end} bytes`);
    if (crc32c(bytes.subarray(0, crcAt)) !== this.field(crcAt)) throw new MrrFileError("CORRUPT", crcAt, "the header's checksum does not fit it");
    if (this.version === 1) return;
    const whole = this.size(At2.FileBytes);
    if (bytes.length !== whole) {
      throw new MrrFileError(bytes.length < whole ? "TRUNCATED_INPUT" : "CORRUPT", bytes.length, `the file has ${bytes.length} bytes, and its header says ${whole}`);
    }
  }

  private readGrid(): Grid {
    const encoding = this.field(At2.Encoding), bits = this.field(At2.Bits), step = this.double(At2.Step);
    const origin = [0, 8, 16].map((n) => this.double(At2.Origin + n)) as [number, number, number];
    if (encoding !== Encoding.Float64 && encoding !== Encoding.Float32 && encoding !== Encoding.Quantised) {
      throw new MrrFileError("CORRUPT", At2.Encoding, `there is no encoding ${encoding}`);
    }
    if (encoding !== Encoding.Quantised && (bits !== 0 || step !== 0 || origin.some((value) => value !== 0))) {
      throw new MrrFileError("CORRUPT", At2.Bits, `the encoding ${encoding} has no grid, and one is given`);
    }
    return { encoding, bits, origin, step };
  }

  private readUnit(): (typeof units)[number] {
    const unit = this.field(At2.Unit);
    if (unit >= units.length) throw new MrrFileError("CORRUPT", At2.Unit, `there is no unit ${unit}; known are 0 to ${units.length - 1}`);
    return units[unit];
  }

  private plainBaseBytes(): number {
    return 24 * this.field(At.Vertices) + 12 * this.field(At.Faces);
  }

  private findSections(): Sections {
    const begin = this.version === 1 ? At1.End : At2.End;
    const description = begin + (this.version === 1 ? this.plainBaseBytes() : this.size(At2.BaseBytes));
    const index = description + this.field(At.Description);
    const blocks = index + (this.version === 1 ? 0 : indexBytes * this.field(At2.Blocks));
    return { base: [begin, description], description: [description, index], index: [index, blocks], blocks };
  }

  private checkSizes(): void {
    const begin = this.sections.base[0], due = this.sections.blocks - begin, left = this.bytes.length - begin;
    const what = this.version === 1 ? "base mesh and description" : "base mesh, description and block index";
    if (due > left) throw new MrrFileError("TRUNCATED_INPUT", begin, `${what} take ${due} bytes; the file has ${left} more`);
    if (3 * (this.field(At.Faces) + 2 * this.splits) >= 0xffffffff) throw new MrrFileError("CORRUPT", At.Splits, "the finest level would have more corners than 32 bits can number");
    if (this.splits > this.records) throw new MrrFileError("CORRUPT", At.Splits, `${this.splits} splits among ${this.records} records`);
    if (crc32c(this.bytes.subarray(begin, this.sections.blocks)) !== this.field(this.version === 1 ? At1.BaseCrc : At2.BodyCrc)) {
      throw new MrrFileError("CORRUPT", begin, `the checksum of ${what} does not fit them`);
    }
    const base = this.sections.base[1] - begin;
    if (this.grid.encoding === Encoding.Float64 && base !== this.plainBaseBytes()) {
      throw new MrrFileError("CORRUPT", At2.BaseBytes, `the base mesh takes ${this.plainBaseBytes()} bytes, not ${base}`);
    }
  }

  private checkPlace(first: number, count: number, read: number, at: number): void {
    const due = this.records - read;
    if (first === read && count > 0 && count <= due) return;
    throw new MrrFileError("CORRUPT", at, `a block has records ${first} and on, ${count} in all, where up to ${due} from ${read} on are due`);
  }

  private cut(read: number): MrrFileError {
    return new MrrFileError("TRUNCATED_INPUT", this.bytes.length, `the file ends after ${read} of ${this.records} records`);
  }

  private readIndex(): BlockEntry[] {
    const index: BlockEntry[] = [];
    let read = 0, end = this.sections.blocks;
    for (let at = this.sections.index[0]; at < this.sections.index[1]; at += indexBytes) {
      const [first, count, splits, faces] = [0, 4, 8, 12].map((n) => this.field(at + n)) as [number, number, number, number];
      const deviation = this.length(at + 16, true), offset = this.size(at + 24), bytes = this.field(at + 32);
      this.checkPlace(first, count, read, at);
      if (offset !== end) throw new MrrFileError("CORRUPT", at + 24, `a block begins at byte ${offset}, where the one before ends at ${end}`);
      if (bytes > this.bytes.length - end) throw this.cut(read);
      index.push({ first, count, splits, faces, deviation, offset, bytes, crc32c: this.field(at + 36) });
      read += count;
      end += bytes;
    }
    if (read < this.records) throw new MrrFileError("CORRUPT", At.Records, `the blocks have ${read} records, not ${this.records}`);
    return index;
  }

  /** Version 1 has no index, but says this before each block. */
  private *places(): Generator<Omit<BlockEntry, "splits" | "faces" | "deviation"> & { encoding: number }, void> {
    if (this.version > 1) {
      for (const entry of this.index) yield { ...entry, encoding: this.grid.encoding };
      return;
    }
    let at = this.sections.blocks, read = 0;
    while (read < this.records) {
      if (this.bytes.length - at < blockHeaderBytes) throw this.cut(read);
      const [first, count, encoding, bytes, crc] = [0, 4, 8, 12, 16].map((n) => this.field(at + n)) as [number, number, number, number, number];
      this.checkPlace(first, count, read, at);
      at += blockHeaderBytes;
      if (bytes > this.bytes.length - at) throw this.cut(read);
      yield { first, count, encoding, offset: at, bytes, crc32c: crc };
      at += bytes;
      read += count;
    }
  }

  private readBase(): MrrFile["base"] {
    const [from, to] = this.sections.base;
    const ghosts = this.field(At.Ghosts), vertices = this.field(At.Vertices), faces = this.field(At.Faces);
    const { positions, corners } =
      this.grid.encoding === Encoding.Float64 ? this.plainBase(vertices, faces) : unpackBase(this.bytes.subarray(from, to), { vertices, faces, ghosts }, this.grid);
    const fault = (what: string): MrrFileError => new MrrFileError("CORRUPT", from, `the base mesh: ${what}`);
    let seen = 0;
    for (let f = 0; f < corners.length / 3; ++f) {
      const touched = corners.subarray(3 * f, 3 * f + 3).filter((vertex) => vertex < ghosts).length;
      if (touched > 1) throw fault(`face ${f} joins two ghosts`);
      if (touched === 0) ++seen;
    }
    if (seen === 0) throw fault("no face of it is to be seen");
    return { positions, corners, ghosts };
  }

  private plainBase(vertices: number, faces: number): BaseMesh {
    const positions = new Float64Array(3 * vertices), corners = new Uint32Array(3 * faces);
    const at = this.sections.base[0], cornersAt = at + 8 * positions.length;
    positions.forEach((_, n) => (positions[n] = this.double(at + 8 * n)));
    corners.forEach((_, n) => (corners[n] = this.field(cornersAt + 4 * n)));
    return { positions, corners };
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
