import { decompress } from "fzstd";
import { CorruptError } from "./errors.js";
import type { Grid } from "./grid.js";
import { wasmBytes } from "./wasm_bytes.js";

/** What wasm/decoder.cpp exports; docs are there. Addresses and counts may come back below 0: they are numbers of 32 bits. */
interface Exports {
  memory: WebAssembly.Memory;
  _initialize(): void;
  view(): number;
  room(bytes: number): number;
  crc32c(before: number): number;
  grid(encoding: number, bits: number, x: number, y: number, z: number, step: number): number;
  unpack_base(vertices: number, faces: number, ghosts: number): number;
  begin(vertices: number, faces: number, ghosts: number): number;
  foresee(splits: number): void;
  append(first: number, count: number, encoding: number, crc32c: number): number;
  coarsen(levels: number): void;
  refine(level: number): void;
  rewind(records: number): void;
  follow(): void;
  changes(): void;
}

/** Where the numbers of the view are. */
const enum At {
  Positions,
  Vertices,
  Corners,
  Faces,
  Level,
  Records,
  Undone,
  Changes,
  ChangeCount,
  Error,
  ErrorSize,
  End,
}

let compiled: WebAssembly.Module | undefined;

/** Compiled when it is first used, and waited for: a worker and node may, a page need not. */
function module(): WebAssembly.Module {
  compiled ??= new WebAssembly.Module(Uint8Array.from(atob(wasmBytes), (letter) => letter.charCodeAt(0)));
  return compiled;
}

/** fzstd compares the array that it fills with a number, which makes a text of it, number by number: here a short one. */
class Room extends Uint8Array {
  override toString(): string {
    return "";
  }
}

/** Unpacks a zstd frame from one place of a memory to another. Returns how many bytes came of it; NaN, which is 0 there, where it is none. */
function unpackFrame(memory: ArrayBuffer, to: number, room: number, from: number, size: number): number {
  try {
    return decompress(new Uint8Array(memory, from >>> 0, size >>> 0), new Room(memory, to >>> 0, room >>> 0)).length;
  } catch {
    return NaN;
  }
}

/**
 * An instance of core's decoder, with a memory of its own for one mesh: both go when nobody knows the instance any more. What is seen of
 * its memory is seen until the next call.
 */
export class Engine {
  private readonly exports: Exports;
  private readonly viewAt: number;

  constructor() {
    const memory = (): ArrayBuffer => this.exports.memory.buffer;
    const decoder = {
      random: () => Math.floor(Math.random() * 2 ** 32),
      number_text: (value: number, to: number, room: number) =>
        new TextEncoder().encodeInto(String(Number(value.toPrecision(6))), new Uint8Array(memory(), to >>> 0, room)).written,
      unpack_frame: (to: number, room: number, from: number, size: number) => unpackFrame(memory(), to, room, from, size),
    };
    this.exports = new WebAssembly.Instance(module(), { decoder }).exports as unknown as Exports;
    this.exports._initialize();
    this.viewAt = this.exports.view();
  }

  /** Throws CorruptError for one that there is not. */
  setGrid({ encoding, bits, origin, step }: Grid): void {
    this.check(this.call((to) => to.grid(encoding, bits, ...origin, step)));
  }

  crc32c(bytes: Uint8Array, before: number): number {
    this.put([bytes]);
    return this.exports.crc32c(before) >>> 0;
  }

  /** On the grid that was set. Throws CorruptError. */
  unpackBase(packed: Uint8Array, vertices: number, faces: number, ghosts: number): void {
    this.put([packed]);
    this.check(this.call((to) => to.unpack_base(vertices, faces, ghosts)));
  }

  /** Throws CorruptError. */
  begin(positions: Float64Array, corners: Uint32Array, ghosts: number): void {
    this.put([positions, corners].map((array) => new Uint8Array(array.buffer, array.byteOffset, array.byteLength)));
    this.check(this.call((to) => to.begin(positions.length / 3, corners.length / 3, ghosts)));
  }

  /** Throws CorruptError. */
  append(first: number, count: number, encoding: number, crc32c: number, payload: Uint8Array): void {
    this.put([payload]);
    this.check(this.call((to) => to.append(first, count, encoding, crc32c)));
  }

  /** Throws RangeError where there is no memory left; the mesh is of no use then. */
  call<Result>(what: (to: Exports) => Result): Result {
    try {
      return what(this.exports);
    } catch (error) {
      if (error instanceof WebAssembly.RuntimeError) throw new RangeError(`no memory is left for the mesh: ${error.message}`);
      throw error;
    }
  }

  get vertices(): number {
    return this.number(At.Vertices);
  }
  get faces(): number {
    return this.number(At.Faces);
  }
  get level(): number {
    return this.number(At.Level);
  }
  get records(): number {
    return this.number(At.Records);
  }
  get undone(): number {
    return this.number(At.Undone);
  }
  get positions(): Float64Array {
    return new Float64Array(this.exports.memory.buffer, this.number(At.Positions), 3 * this.vertices);
  }
  get corners(): Uint32Array {
    return new Uint32Array(this.exports.memory.buffer, this.number(At.Corners), 3 * this.faces);
  }
  get changes(): Uint32Array {
    return new Uint32Array(this.exports.memory.buffer, this.number(At.Changes), this.number(At.ChangeCount));
  }

  private number(at: At): number {
    return new Uint32Array(this.exports.memory.buffer, this.viewAt, At.End)[at]!;
  }

  private put(parts: Uint8Array[]): void {
    const size = parts.reduce((sum, part) => sum + part.length, 0);
    let to = this.call((exports) => exports.room(size)) >>> 0;
    const memory = new Uint8Array(this.exports.memory.buffer);
    for (const part of parts) {
      memory.set(part, to);
      to += part.length;
    }
  }

  private check(done: number): void {
    if (done) return;
    throw new CorruptError(new TextDecoder().decode(new Uint8Array(this.exports.memory.buffer, this.number(At.Error), this.number(At.ErrorSize))));
  }
}

let shared: Engine | undefined;

/** One that stays, for what needs no mesh and little memory. */
export function sharedEngine(): Engine {
  return (shared ??= new Engine());
}
