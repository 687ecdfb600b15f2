import { decompress } from "fzstd";
import { CorruptError } from "./errors.js";

/** Columns of a compressed block; docs/format.md describes them. */
export const enum Column {
  Kinds = 0,
  Place = 1,
  OddPlace = 2,
  Mean = 3,
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

// Of the symbols of numbers, how many bits follow and what they are added to: nobody can foresee whether any do, so this is looked
// up, not branched to.
const widths = Int32Array.from({ length: 256 }, (_, symbol) => (symbol < 16 ? 0 : ((symbol - 16) >>> 3) + 1));
const bases = Int32Array.from(widths, (width, symbol) => (symbol < 16 ? symbol : (8 | (symbol & 7)) << width));

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

/** Bits in the order in which they were written, lowest first. */
class BitColumn {
  private at = 0;
  constructor(private readonly bytes: Uint8Array, private readonly count: number) {}

  get left(): number {
    return this.count - this.at;
  }

  /** `width` is from 0 to 31, and no more than are left. */
  read(width: number): number {
    const { bytes, at } = this;
    this.at = at + width;
    const first = at >>> 3;
    const shift = at & 7;
    const four = bytes[first]! | (bytes[first + 1]! << 8) | (bytes[first + 2]! << 16) | (bytes[first + 3]! << 24);
    const mask = (1 << width) - 1;
    if (width + shift <= 32) return (four >>> shift) & mask;
    return ((four >>> shift) | (bytes[first + 4]! << (32 - shift))) & mask;
  }
}

/** Gives the symbols of a payload back. Reading beyond the end of a column gives 0 and is remembered in `short`. */
export class ColumnReader {
  short = false;
  /** All columns one after the other, and where what is left of each begins and ends. */
  private readonly bytes: Uint8Array;
  private readonly at = new Int32Array(Column.Bits);
  private readonly end = new Int32Array(Column.Bits);
  private readonly rest: BitColumn;
  private readonly places: BitColumn;

  /** `most`: bytes that the columns may unpack to. */
  constructor(payload: Uint8Array, most: number) {
    const stored = new Array<Stored | undefined>(Column.PlaceBits + 1).fill(undefined);
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
      const bytes = payload.subarray(next, next + size);
      next += size;
      const content = compressed ? frameContentSize(bytes) : size;
      if (content === 0 || content > most - total) throw new CorruptError(`column ${column} would unpack to too much or nothing`);
      stored[column] = { bytes, compressed, content };
      total += content;
    }
    this.bytes = new Room(total);
    let to = 0;
    for (let column = 0; column < Column.Bits; ++column) {
      const from = stored[column];
      this.at[column] = to;
      if (from) unpack(from, column, this.bytes.subarray(to, to + from.content));
      to += from ? from.content : 0;
      this.end[column] = to;
    }
    this.rest = bitColumn(stored[Column.Bits], Column.Bits);
    this.places = bitColumn(stored[Column.PlaceBits], Column.PlaceBits);
  }

  byte(column: number): number {
    const at = this.at[column]!;
    if (at >= this.end[column]!) {
      this.short = true;
      return 0;
    }
    this.at[column] = at + 1;
    return this.bytes[at]!;
  }

  /** Whether the column's next symbol is this one; only then is it read. */
  skip(column: number, symbol: number): boolean {
    const at = this.at[column]!;
    if (at >= this.end[column]! || this.bytes[at] !== symbol) return false;
    this.at[column] = at + 1;
    return true;
  }

  private bits(of: BitColumn, width: number): number {
    if (width <= of.left) return of.read(width);
    this.short = true;
    return 0;
  }

  number(column: number): number {
    const symbol = this.byte(column);
    if (symbol > largestToken) this.short = true;
    return (bases[symbol]! | this.bits(this.rest, widths[symbol]!)) >>> 0;
  }

  /** A number below `count` of which any is as likely. */
  uniform(column: number, count: number): number {
    const low = lowBits(count);
    const high = this.byte(column);
    return ((high << low) | this.bits(this.rest, low)) >>> 0;
  }

  /** The low bits of a place. */
  placeBits(width: number): number {
    return this.bits(this.places, width);
  }

  /** All symbols of a column, which then are read. */
  take(column: number): Uint8Array {
    const all = this.bytes.subarray(this.at[column], this.end[column]);
    this.at[column] = this.end[column]!;
    return all;
  }

  /** Whether all that was there was read; the bits that fill up the last byte are 0. */
  allRead(): boolean {
    for (let column = 0; column < Column.Bits; ++column) {
      if (this.at[column] !== this.end[column]) return false;
    }
    for (const of of [this.rest, this.places]) {
      if (of.left >= 8 || this.bits(of, of.left) !== 0) return false;
    }
    return true;
  }
}

interface Stored {
  bytes: Uint8Array;
  compressed: boolean;
  /** Bytes that it unpacks to. */
  content: number;
}

/** fzstd compares the array that it fills with a number, which makes a text of it, number by number: here a short one. */
class Room extends Uint8Array {
  override toString(): string {
    return "";
  }
}

function unpack(from: Stored, column: number, to: Uint8Array): void {
  if (!from.compressed) {
    to.set(from.bytes);
    return;
  }
  let unpacked: Uint8Array;
  try {
    unpacked = decompress(from.bytes, to);
  } catch (error) {
    throw new CorruptError(`column ${column} is no whole zstd frame: ${String(error)}`);
  }
  if (unpacked.length !== to.length) throw new CorruptError(`column ${column} is no whole zstd frame`);
}

/** Room for five bytes is behind the last. */
function bitColumn(from: Stored | undefined, column: number): BitColumn {
  const size = from ? from.content : 0;
  const bytes = new Room(size + 5);
  if (from) unpack(from, column, bytes.subarray(0, size));
  return new BitColumn(bytes, 8 * size);
}

/** Of the largest number below `count`. */
export function bitWidth(count: number): number {
  return 32 - Math.clz32(count - 1);
}

/** How many of the bits of a number below `count` are stored as they are. */
export function lowBits(count: number): number {
  return Math.max(0, bitWidth(count) - 7);
}

/** 0, 1, 2, 3, 4 ... as 0, -1, 1, -2, 2 ... */
export function fromZigzag(value: number): number {
  return (value >>> 1) ^ -(value & 1);
}
