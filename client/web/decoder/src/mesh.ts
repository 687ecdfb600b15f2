import { CorruptError } from "./errors.js";
import { largestCoordinate } from "./grid.js";
import { UndoneRecords } from "./undone.js";

const none = 0xffffffff;

// `| 0` here and where corners are read keeps the numbers of a mesh whole numbers of 32 bits for the compiler; they stay below 2^31.
export const next = (h: number): number => (h % 3 === 2 ? (h - 2) | 0 : (h + 1) | 0);
export const prev = (h: number): number => (h % 3 === 0 ? (h + 2) | 0 : (h - 1) | 0);

function grown<T extends Uint32Array | Float64Array | Uint8Array>(array: T, needed: number): T {
  if (needed <= array.length) return array;
  const larger = new (array.constructor as new (size: number) => T)(Math.max(needed, 2 * array.length));
  larger.set(array as never);
  return larger;
}

export const enum Kind {
  Split = 0,
  Flip = 1,
  Move = 2,
}

/**
 * A mesh that records are applied to and undone on: the counterpart of core's ProgressiveMesh, bit for bit. Corner 3f + c is the
 * c-th of face f. Only the first `vertexCount` and `faceCount` elements of the arrays count, and the arrays are others after they
 * have grown.
 */
export class ProgressiveMesh {
  vertexCount: number;
  faceCount: number;
  /** Vertex of each corner. */
  corners: Uint32Array;
  /** x, y and z of each vertex. */
  positions: Float64Array;
  twins: Uint32Array;
  cornerOf: Uint32Array;
  level = 0;
  /** Records applied. */
  records = 0;
  /** Told of every vertex that moved or whose ring changed, old and new, where it is set. */
  touched: ((vertex: number) => void) | undefined;

  private readonly undone = new UndoneRecords();

  private applied = new Uint8Array(1024);
  private edited = new Uint32Array(1024);
  private editedCount = 0;
  private lay = new Float64Array(3 * 1024);
  private layCount = 0;

  /** The mesh must be closed and manifold. Takes the arrays over. */
  constructor(positions: Float64Array, corners: Uint32Array, readonly ghosts = 0) {
    this.vertexCount = positions.length / 3;
    this.faceCount = corners.length / 3;
    this.positions = positions;
    this.corners = corners;
    this.twins = new Uint32Array(corners.length);
    this.cornerOf = new Uint32Array(this.vertexCount).fill(none);
    this.check();
    this.pair();
  }

  private check(): void {
    for (const v of this.corners) {
      if (v >= this.vertexCount) throw new CorruptError(`base mesh: vertex ${v} of ${this.vertexCount}`);
    }
    for (let n = 0; n < this.positions.length; ++n) {
      if (!(Math.abs(this.positions[n]!) <= largestCoordinate)) throw new CorruptError("base mesh: a coordinate is beyond 1e15");
    }
  }

  private pair(): void {
    const open = new Map<number, number>();
    for (let h = 0; h < this.corners.length; ++h) {
      const from = this.corners[h]!;
      const key = from * this.vertexCount + this.corners[next(h)]!;
      if (open.has(key)) throw new CorruptError("base mesh: two faces run along an edge the same way");
      open.set(key, h);
      this.cornerOf[from] = h;
    }
    for (let h = 0; h < this.corners.length; ++h) {
      const twin = open.get(this.corners[next(h)]! * this.vertexCount + this.corners[h]!);
      if (twin === undefined) throw new CorruptError("base mesh: it is not closed");
      this.twins[h] = twin;
    }
    this.checkFans();
  }

  /** Every vertex has one fan of faces. */
  private checkFans(): void {
    const faces = new Uint32Array(this.vertexCount);
    for (const v of this.corners) ++faces[v]!;
    for (let v = 0; v < this.vertexCount; ++v) {
      const start = this.cornerOf[v]!;
      if (start === none) throw new CorruptError(`base mesh: vertex ${v} has no face`);
      let turned = 0;
      let h = start;
      do {
        h = this.twins[prev(h)]!;
        ++turned;
      } while (h !== start);
      if (turned !== faces[v]) throw new CorruptError(`base mesh: vertex ${v} joins several fans of faces`);
    }
  }

  /** Makes room for more records at once. */
  reserve(splits: number, edits: number): void {
    this.positions = grown(this.positions, 3 * (this.vertexCount + splits));
    this.cornerOf = grown(this.cornerOf, this.vertexCount + splits);
    this.corners = grown(this.corners, 3 * this.faceCount + 6 * splits);
    this.twins = grown(this.twins, 3 * this.faceCount + 6 * splits);
    this.applied = grown(this.applied, this.records + splits + edits);
    this.edited = grown(this.edited, this.editedCount + edits);
    this.lay = grown(this.lay, 3 * (this.layCount + splits + edits));
  }

  private remember(v: number): void {
    const from = 3 * v;
    const to = 3 * this.layCount++;
    this.lay[to] = this.positions[from]!;
    this.lay[to + 1] = this.positions[from + 1]!;
    this.lay[to + 2] = this.positions[from + 2]!;
  }

  private restore(v: number): void {
    const from = 3 * --this.layCount;
    this.positions[3 * v] = this.lay[from]!;
    this.positions[3 * v + 1] = this.lay[from + 1]!;
    this.positions[3 * v + 2] = this.lay[from + 2]!;
  }

  /** `steps` must be from 1 to the valence less 1. Room must have been made. */
  split(anchor: number, steps: number, kx: number, ky: number, kz: number, ax: number, ay: number, az: number): void {
    const { corners, twins, positions, ghosts } = this;
    const v = corners[anchor]! | 0;
    const b = corners[next(anchor)]! | 0;
    const w = this.vertexCount | 0;
    let fanEnd = anchor;
    let after = anchor | 0;
    for (let n = 0; n < steps; ++n) {
      corners[after] = w;
      fanEnd = prev(after);
      after = twins[fanEnd]! | 0;
    }
    const e = corners[fanEnd]! | 0;
    if (ghosts > 0 && (v < ghosts || (b < ghosts && e < ghosts))) {
      for (let n = 0, corner = anchor; n < steps; ++n, corner = twins[prev(corner)]!) corners[corner] = v;
      throw new CorruptError("a split at or between ghosts");
    }
    this.vertexCount = w + 1;
    const before = twins[anchor]! | 0;
    const first = 3 * this.faceCount;
    this.faceCount += 2;
    corners[first] = v;
    corners[first + 1] = w;
    corners[first + 2] = e;
    corners[first + 3] = w;
    corners[first + 4] = v;
    corners[first + 5] = b;
    twins[first] = first + 3;
    twins[first + 1] = fanEnd;
    twins[first + 2] = after;
    twins[first + 3] = first;
    twins[first + 4] = before;
    twins[first + 5] = anchor;
    twins[fanEnd] = first + 1;
    twins[after] = first + 2;
    twins[before] = first + 4;
    twins[anchor] = first + 5;
    this.cornerOf[v] = first;
    this.cornerOf[w] = first + 1;
    this.remember(v);
    positions[3 * v] = kx;
    positions[3 * v + 1] = ky;
    positions[3 * v + 2] = kz;
    positions[3 * w] = ax;
    positions[3 * w + 1] = ay;
    positions[3 * w + 2] = az;
    ++this.level;
    this.applied[this.records++] = Kind.Split;
    if (this.touched) {
      for (const vertex of [v, w, b, e]) this.touched(vertex);
    }
  }

  private undoSplit(keep: boolean): void {
    const { corners, twins } = this;
    const first = 3 * this.faceCount - 6;
    const v = corners[first]!;
    const fanEnd = twins[first + 1]!;
    const after = twins[first + 2]!;
    const before = twins[first + 4]!;
    const fanBegin = twins[first + 5]!;
    let steps = 1;
    for (let corner = fanBegin; ; corner = twins[prev(corner)]!, ++steps) {
      corners[corner] = v;
      if (prev(corner) === fanEnd) break;
    }
    if (keep) {
      const p = this.positions, k = 3 * v, a = 3 * (this.vertexCount - 1);
      this.undone.push(Kind.Split, fanBegin, steps, p[k]!, p[k + 1]!, p[k + 2]!, p[a]!, p[a + 1]!, p[a + 2]!);
    }
    twins[fanEnd] = after;
    twins[after] = fanEnd;
    twins[before] = fanBegin;
    twins[fanBegin] = before;
    this.faceCount -= 2;
    --this.vertexCount;
    // A flip may have left one of the others with a corner of the faces that go.
    this.cornerOf[v] = fanBegin;
    this.cornerOf[corners[fanEnd]!] = fanEnd;
    this.cornerOf[corners[before]!] = before;
    this.restore(v);
    --this.level;
    if (this.touched) {
      for (const vertex of [v, corners[fanEnd]!, corners[before]!]) this.touched(vertex);
    }
  }

  private valenceIsUnder4(corner: number): boolean {
    let at = corner;
    for (let n = 1; n < 4; ++n) {
      at = this.twins[prev(at)]!;
      if (at === corner) return true;
    }
    return false;
  }

  private areJoined(corner: number, to: number): boolean {
    let at = corner;
    do {
      if (this.corners[next(at)] === to) return true;
      at = this.twins[prev(at)]!;
    } while (at !== corner);
    return false;
  }

  /** Turns an edge clockwise. Room must have been made. */
  flip(h: number): void {
    if (h >= 3 * this.faceCount) throw new CorruptError(`${h} is no half-edge`);
    const g = this.twins[h]!;
    for (const corner of [h, prev(h), g, prev(g)]) {
      if (this.corners[corner]! < this.ghosts) throw new CorruptError("a flip beside a ghost");
    }
    if (this.valenceIsUnder4(h) || this.valenceIsUnder4(g)) throw new CorruptError("a flip at a valence under 4");
    if (this.areJoined(prev(h), this.corners[prev(g)]!)) throw new CorruptError("a flip to an edge that is there");
    this.turn(h, true);
    this.touchQuad(h);
    this.edited[this.editedCount++] = h;
    this.applied[this.records++] = Kind.Flip;
  }

  private touchQuad(h: number): void {
    if (!this.touched) return;
    for (const corner of [h, prev(h), this.twins[h]!, prev(this.twins[h]!)]) this.touched(this.corners[corner]!);
  }

  private turn(h: number, clockwise: boolean): void {
    const { corners, twins } = this;
    const g = twins[h]!;
    const h1 = next(h), h2 = prev(h), g1 = next(g), g2 = prev(g);
    const a = corners[h]!, b = corners[g]!, c = corners[h2]!, d = corners[g2]!;
    const t1 = twins[h1]!, t2 = twins[h2]!, u1 = twins[g1]!, u2 = twins[g2]!;
    const put = (i: number, v: number, twin: number): void => {
      corners[i] = v;
      twins[i] = twin;
      twins[twin] = i;
      this.cornerOf[v] = i;
    };
    if (clockwise) {
      put(h1, d, u2);
      put(h2, b, t1);
      put(g1, c, t2);
      put(g2, a, u1);
      corners[h] = c;
      corners[g] = d;
      this.cornerOf[c] = h;
      this.cornerOf[d] = g;
    } else {
      put(h1, c, t2);
      put(h2, a, u1);
      put(g1, d, u2);
      put(g2, b, t1);
      corners[h] = d;
      corners[g] = c;
      this.cornerOf[d] = h;
      this.cornerOf[c] = g;
    }
  }

  /** Room must have been made. */
  move(v: number, x: number, y: number, z: number): void {
    if (v >= this.vertexCount || v < this.ghosts) throw new CorruptError(`a move of vertex ${v}`);
    this.remember(v);
    this.positions[3 * v] = x;
    this.positions[3 * v + 1] = y;
    this.positions[3 * v + 2] = z;
    this.edited[this.editedCount++] = v;
    this.applied[this.records++] = Kind.Move;
    this.touched?.(v);
  }

  private undoLast(keep: boolean): void {
    const kind = this.applied[--this.records]!;
    if (kind === Kind.Split) {
      this.undoSplit(keep);
      return;
    }
    const edited = this.edited[--this.editedCount]!;
    if (kind === Kind.Flip) {
      if (keep) this.undone.push(kind, edited, 0, 0, 0, 0);
      this.turn(edited, false);
      this.touchQuad(edited);
    } else {
      const p = this.positions, at = 3 * edited;
      if (keep) this.undone.push(kind, edited, 0, p[at]!, p[at + 1]!, p[at + 2]!);
      this.restore(edited);
      this.touched?.(edited);
    }
  }

  /** Undoes records until `records` are left, for good. */
  rewind(records: number): void {
    while (this.records > records) this.undoLast(false);
  }

  /**
   * Undoes the edits after the last split, then `levels` splits, each with the edits before it. They are kept for `refine`; blocks
   * can be decoded again once all are back.
   */
  coarsen(levels: number): void {
    const target = Math.max(0, this.level - levels);
    while (this.records > 0 && (this.level > target || this.applied[this.records - 1] !== Kind.Split)) this.undoLast(true);
  }

  /** Records that `coarsen` undid. */
  get recordsUndone(): number {
    return this.undone.count;
  }

  /** Applies records that `coarsen` undid, up to the split that makes `level`; all where there are none so far. */
  refine(level: number): void {
    const { undone } = this;
    while (undone.count > 0 && this.level < level) this.redo();
  }

  /** Applies all that `coarsen` undid. */
  refineAll(): void {
    while (this.undone.count > 0) this.redo();
  }

  private redo(): void {
    const { undone } = this;
    const kind = undone.kind(), a = undone.number(0), b = undone.number(1);
    const place = (n: number): number => undone.place(n);
    if (kind === Kind.Split) this.split(a, b, place(0), place(1), place(2), place(3), place(4), place(5));
    else if (kind === Kind.Flip) this.flip(a);
    else this.move(a, place(0), place(1), place(2));
    undone.pop();
  }

  /** The mesh without ghosts, as new arrays. */
  visible(): { positions: Float64Array; indices: Uint32Array } {
    const positions = this.positions.slice(3 * this.ghosts, 3 * this.vertexCount);
    if (this.ghosts === 0) return { positions, indices: this.corners.slice(0, 3 * this.faceCount) };
    const indices: number[] = [];
    for (let h = 0; h < 3 * this.faceCount; h += 3) {
      const a = this.corners[h]!, b = this.corners[h + 1]!, c = this.corners[h + 2]!;
      if (Math.min(a, b, c) >= this.ghosts) indices.push(a - this.ghosts, b - this.ghosts, c - this.ghosts);
    }
    return { positions, indices: Uint32Array.from(indices) };
  }
}
