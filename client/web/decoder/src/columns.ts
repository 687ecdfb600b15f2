import { decompress } from "fzstd";
import { CorruptError } from "./errors.js";

/** Columns of a compressed block; docs/format.md describes them. */
export const enum Column {
  Kinds = 0,
  Place = 1,
  Fan = 2,
  LargeFan = 13,
  Flip = 14,
  Moved = 15,
  Along = 16,
  Across = 48,
  MoveAlong = 80,
  MoveAcross = 112,
  Bits = 144,
  PlaceBits = 145,
}

const largestToken = 16 + 27 * 8 + 7;
const nothing = new Uint8Array(0);

/** What a zstd frame says it unpacks to; 0 where it says nothing. */
function frameContentSize(frame: Uint8Array): number {
  if (frame.length < 6 || frame[0] !== 0x28 || frame[1] !== 0xb5 || frame[2] !== 0x2f || frame[3] !== 0xfd) return 0;
  const descriptor = frame[4]!;
  const single = (descriptor >> 5) & 1;
  const flag = descriptor >> 6;
  const at = 5 + (single ? 0 : 1) + [0, 1, 2, 4][descriptor & 3]!;
  const width = flag === 0 ? single : 1 << flag;
  if (at + width > frame.length || width > 4) return 0;
  let size = 0;
  for (let n = width - 1; n >= 0; --n) size = size * 256 + frame[at + n]!;
  return width === 2 ? size + 256 : size;
}

/** Gives the symbols of a payload back. Reading beyond the end of a column gives 0 and is remembered in `short`. */
export class ColumnReader {
  short = false;
  private readonly columns: Uint8Array[] = new Array<Uint8Array>(Column.PlaceBits + 1).fill(nothing);
  private readonly at = new Int32Array(Column.Bits);
  // Of Bits and PlaceBits.
  private readonly bitAt = [0, 0];
  private readonly bitCount = [0, 0];

  /** `most`: bytes that the columns may unpack to. */
  constructor(payload: Uint8Array, most: number) {
    let total = 0;
    let last = -1;
    let next = 0;
    while (next < payload.length) {
      const column = payload[next++]!;
      if (column > Column.PlaceBits || column <= last) throw new CorruptError(`column ${column} where a higher one up to 145 is due`);
      last = column;
      let size = 0;
      let shift = 1;
      for (let more = true; more; shift *= 128) {
        if (next >= payload.length || shift > 2 ** 35) throw new CorruptError("a column does not end where its block does");
        const byte = payload[next++]!;
        size += (byte & 0x7f) * shift;
        more = byte >= 0x80;
      }
      const compressed = size % 2 === 1;
      size = Math.floor(size / 2);
      if (size > payload.length - next) throw new CorruptError("a column does not end where its block does");
      const stored = payload.subarray(next, next + size);
      next += size;
      const content = compressed ? frameContentSize(stored) : size;
      if (content === 0 || content > most - total) throw new CorruptError(`column ${column} would unpack to too much or nothing`);
      total += content;
      this.columns[column] = compressed ? unpack(stored, content, column) : stored;
    }
    for (const column of [Column.Bits, Column.PlaceBits]) {
      const bits = this.columns[column]!;
      const padded = new Uint8Array(bits.length + 8);
      padded.set(bits);
      this.columns[column] = padded;
      this.bitCount[column - Column.Bits] = 8 * bits.length;
    }
  }

  byte(column: number): number {
    const bytes = this.columns[column]!;
    const at = this.at[column]!;
    if (at >= bytes.length) {
      this.short = true;
      return 0;
    }
    this.at[column] = at + 1;
    return bytes[at]!;
  }

  /** `width` is at most 32. */
  bits(width: number, column: number = Column.Bits): number {
    if (width === 0) return 0;
    const stream = column - Column.Bits;
    const begin = this.bitAt[stream]!;
    this.bitAt[stream] = begin + width;
    if (begin + width > this.bitCount[stream]!) {
      this.short = true;
      return 0;
    }
    const bytes = this.columns[column]!;
    const at = begin >>> 3;
    const shift = begin & 7;
    const four = bytes[at]! | (bytes[at + 1]! << 8) | (bytes[at + 2]! << 16) | (bytes[at + 3]! << 24);
    let value = four >>> shift;
    if (shift > 0) value |= bytes[at + 4]! << (32 - shift);
    return width === 32 ? value >>> 0 : (value & ((1 << width) - 1)) >>> 0;
  }

  number(column: number): number {
    const symbol = this.byte(column);
    if (symbol < 16) return symbol;
    if (symbol > largestToken) this.short = true;
    const width = ((symbol - 16) >>> 3) + 1;
    return (((8 | (symbol & 7)) << width) | this.bits(width)) >>> 0;
  }

  /** A number below `count` of which any is as likely. */
  uniform(column: number, count: number): number {
    const low = lowBits(count);
    const high = this.byte(column);
    return ((high << low) | this.bits(low)) >>> 0;
  }

  /** All symbols of a column. */
  whole(column: number): Uint8Array {
    return this.columns[column]!;
  }

  skip(column: number): void {
    this.at[column] = this.columns[column]!.length;
  }

  /** Whether all that was there was read; the bits that fill up the last byte are 0. */
  allRead(): boolean {
    for (let column = 0; column < Column.Bits; ++column) {
      if (this.at[column] !== this.columns[column]!.length) return false;
    }
    for (const column of [Column.Bits, Column.PlaceBits]) {
      const left = this.bitCount[column - Column.Bits]! - this.bitAt[column - Column.Bits]!;
      if (left < 0 || left >= 8 || this.bits(left, column) !== 0) return false;
    }
    return true;
  }
}

function unpack(frame: Uint8Array, size: number, column: number): Uint8Array {
  let bytes: Uint8Array;
  try {
    bytes = decompress(frame, new Uint8Array(size));
  } catch (error) {
    throw new CorruptError(`column ${column} is no whole zstd frame: ${String(error)}`);
  }
  if (bytes.length !== size) throw new CorruptError(`column ${column} is no whole zstd frame`);
  return bytes;
}

/** How many of the bits of a number below `count` are stored as they are. */
export function lowBits(count: number): number {
  return Math.max(0, 32 - Math.clz32(count - 1) - 7);
}

/** 0, 1, 2, 3, 4 ... as 0, -1, 1, -2, 2 ... */
export function fromZigzag(value: number): number {
  return (value >>> 1) ^ -(value & 1);
}
