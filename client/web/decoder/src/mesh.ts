import { CorruptError } from "./errors.js";
import { largestCoordinate } from "./grid.js";
import { UndoneRecords } from "./undone.js";

const none = -1;

// Nobody can foresee where in its face a corner is, so this is computed, not branched to. `| 0` here and where numbers of a mesh are
// read tells the compiler that they are whole and below 2^31.
export const next = (corner: number): number => (corner + 1 - 3 * ((corner % 3) >> 1)) | 0;
export const prev = (corner: number): number => (corner - 1 + (3 & (((corner % 3) - 1) >> 31))) | 0;

function grown<T extends Uint32Array | Int32Array | Float64Array | Uint8Array>(array: T, needed: number): T {
  if (needed <= array.length) return array;
  const larger = new (array.constructor as new (size: number) => T)(Math.max(needed, 2 * array.length));
  larger.set(array as never);
  return larger;
}

/** How many times as many vertices as there are. */
const mostForeseen = 64;

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
  /** x, y and z of each vertex. */
  positions: Float64Array;
  /**
   * For walks around a vertex, two numbers a corner, side by side because memory is what such a walk waits for: the vertex before it
   * in its face, and the corner at its own vertex in the next face counter-clockwise, the one on the other side of the edge to that.
   */
  around: Int32Array;
  /** A corner at each vertex. */
  cornerOf: Int32Array;
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
    this.around = new Int32Array(2 * corners.length);
    this.cornerOf = new Int32Array(this.vertexCount).fill(none);
    this.check(corners);
    this.pair(corners);
  }

  private check(corners: Uint32Array): void {
    for (const v of corners) {
      if (v >= this.vertexCount) throw new CorruptError(`base mesh: vertex ${v} of ${this.vertexCount}`);
    }
    for (let n = 0; n < this.positions.length; ++n) {
      if (!(Math.abs(this.positions[n]!) <= largestCoordinate)) throw new CorruptError("base mesh: a coordinate is beyond 1e15");
    }
  }

  private pair(corners: Uint32Array): void {
    const open = new Map<number, number>();
    for (let h = 0; h < corners.length; ++h) {
      const from = corners[h]!;
      const key = from * this.vertexCount + corners[next(h)]!;
      if (open.has(key)) throw new CorruptError("base mesh: two faces run along an edge the same way");
      open.set(key, h);
      this.seat(h, from);
      this.cornerOf[from] = h;
    }
    for (let h = 0; h < corners.length; ++h) {
      const twin = open.get(corners[next(h)]! * this.vertexCount + corners[h]!);
      if (twin === undefined) throw new CorruptError("base mesh: it is not closed");
      this.around[2 * next(h) + 1] = twin;
    }
    this.checkFans(corners);
  }

  /** Every vertex has one fan of faces. */
  private checkFans(corners: Uint32Array): void {
    const faces = new Uint32Array(this.vertexCount);
    for (const v of corners) ++faces[v]!;
    for (let v = 0; v < this.vertexCount; ++v) {
      const start = this.cornerOf[v]!;
      if (start === none) throw new CorruptError(`base mesh: vertex ${v} has no face`);
      let turned = 0;
      let h = start;
      do {
        h = this.after(h);
        ++turned;
      } while (h !== start);
      if (turned !== faces[v]) throw new CorruptError(`base mesh: vertex ${v} joins several fans of faces`);
    }
  }

  /** The vertex at a corner. */
  vertexAt(corner: number): number {
    return this.before(next(corner));
  }

  /** The vertices at all corners, as a new array. */
  corners(): Uint32Array {
    const all = new Uint32Array(3 * this.faceCount);
    for (let corner = 0; corner < all.length; ++corner) all[corner] = this.vertexAt(corner);
    return all;
  }

  /** The corner at the same vertex in the next face counter-clockwise. */
  after(corner: number): number {
    return this.around[2 * corner + 1]! | 0;
  }

  private before(corner: number): number {
    return this.around[2 * corner]! | 0;
  }

  private twin(h: number): number {
    return this.around[2 * next(h) + 1]! | 0;
  }

  /** `vertex` is at a corner now. */
  private seat(corner: number, vertex: number): void {
    this.around[2 * next(corner)] = vertex;
  }

  /** A face's vertices and, after each, the corner at it in the next face counter-clockwise. */
  private putFace(first: number, a: number, afterA: number, b: number, afterB: number, c: number, afterC: number): void {
    const { around } = this;
    const at = (2 * first) | 0;
    around[at] = c;
    around[at + 1] = afterA;
    around[at + 2] = a;
    around[at + 3] = afterB;
    around[at + 4] = b;
    around[at + 5] = afterC;
  }

  /** Two half-edges are each other's twins now. */
  private join(h: number, g: number): void {
    this.around[2 * next(h) + 1] = g;
    this.around[2 * next(g) + 1] = h;
  }

  /** Makes room for more records at once. */
  reserve(splits: number, edits: number): void {
    this.positions = grown(this.positions, 3 * (this.vertexCount + splits));
    this.cornerOf = grown(this.cornerOf, this.vertexCount + splits);
    this.around = grown(this.around, 6 * this.faceCount + 12 * splits);
    this.applied = grown(this.applied, this.records + splits + edits);
    this.edited = grown(this.edited, this.editedCount + edits);
    this.lay = grown(this.lay, 3 * (this.layCount + splits + edits));
  }

  /**
   * Makes room for splits that a file or a stream announces, as far as they are at most 64 times as many as there are vertices: what
   * is merely announced is no reason to take much memory.
   */
  foresee(splits: number): void {
    this.reserve(Math.min(splits, mostForeseen * this.vertexCount), 0);
  }

  private place(v: number, places: Float64Array, from: number): void {
    const to = 3 * v;
    this.positions[to] = places[from]!;
    this.positions[to + 1] = places[from + 1]!;
    this.positions[to + 2] = places[from + 2]!;
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

  /**
   * `steps` must be from 1 to the valence less 1; `places`: where the vertex that is split lies afterwards, then the new one, six
   * numbers. Room must have been made.
   */
  split(anchor: number, steps: number, places: Float64Array): void {
    const { around } = this;
    const v = this.vertexAt(anchor), b = this.before(prev(anchor)), w = this.vertexCount | 0;
    let last = anchor | 0;
    for (let n = 1; n < steps; ++n) last = this.after(last);
    const e = this.before(last), after = this.after(last), behind = this.twin(anchor);
    if (v < this.ghosts || (b < this.ghosts && e < this.ghosts)) throw new CorruptError("a split at or between ghosts");
    for (let n = 0, corner = anchor | 0; n < steps; ++n, corner = this.after(corner)) around[2 * next(corner)] = w;
    const first = (3 * this.faceCount) | 0;
    around[2 * last + 1] = first + 1;
    around[2 * next(after) + 1] = first + 2;
    around[2 * next(behind) + 1] = first + 4;
    around[2 * next(anchor) + 1] = first + 5;
    this.putFace(first, v, after, w, first + 3, e, prev(last));
    this.putFace(first + 3, w, anchor, v, first, b, behind);
    this.cornerOf[v] = first;
    this.cornerOf[w] = first + 1;
    this.vertexCount = w + 1;
    this.faceCount += 2;
    this.remember(v);
    this.place(v, places, 0);
    this.place(w, places, 3);
    ++this.level;
    this.applied[this.records++] = Kind.Split;
    if (this.touched) {
      for (const vertex of [v, w, b, e]) this.touched(vertex);
    }
  }

  private undoSplit(keep: boolean): void {
    const { positions } = this;
    const first = 3 * this.faceCount - 6;
    const v = this.vertexAt(first);
    const fanEnd = this.twin(first + 1), after = this.twin(first + 2), behind = this.twin(first + 4), anchor = this.twin(first + 5);
    let steps = 1;
    for (let corner = anchor; ; corner = this.after(corner), ++steps) {
      this.seat(corner, v);
      if (prev(corner) === fanEnd) break;
    }
    if (keep) {
      this.undone.push(Kind.Split, anchor, steps);
      this.undone.keepPlace(0, positions, v);
      this.undone.keepPlace(1, positions, this.vertexCount - 1);
    }
    this.join(fanEnd, after);
    this.join(behind, anchor);
    this.faceCount -= 2;
    --this.vertexCount;
    // A flip may have left one of the others with a corner of the faces that go.
    const e = this.vertexAt(fanEnd), b = this.vertexAt(behind);
    this.cornerOf[v] = anchor;
    this.cornerOf[e] = fanEnd;
    this.cornerOf[b] = behind;
    this.restore(v);
    --this.level;
    if (this.touched) {
      for (const vertex of [v, e, b]) this.touched(vertex);
    }
  }

  private valenceIsUnder4(corner: number): boolean {
    let at = corner;
    for (let n = 1; n < 4; ++n) {
      at = this.after(at);
      if (at === corner) return true;
    }
    return false;
  }

  private areJoined(corner: number, to: number): boolean {
    let at = corner;
    do {
      if (this.before(at) === to) return true;
      at = this.after(at);
    } while (at !== corner);
    return false;
  }

  /** Turns an edge clockwise; returns the half-edge's twin. Room must have been made. */
  flip(h: number): number {
    if (h >= 3 * this.faceCount) throw new CorruptError(`${h} is no half-edge`);
    const g = this.twin(h);
    for (const corner of [h, prev(h), g, prev(g)]) {
      if (this.vertexAt(corner) < this.ghosts) throw new CorruptError("a flip beside a ghost");
    }
    if (this.valenceIsUnder4(h) || this.valenceIsUnder4(g)) throw new CorruptError("a flip at a valence under 4");
    if (this.areJoined(prev(h), this.vertexAt(prev(g)))) throw new CorruptError("a flip to an edge that is there");
    this.turn(h, true);
    this.touchQuad(h);
    this.edited[this.editedCount++] = h;
    this.applied[this.records++] = Kind.Flip;
    return g;
  }

  private touchQuad(h: number): void {
    if (!this.touched) return;
    for (const corner of [h, prev(h), this.twin(h), prev(this.twin(h))]) this.touched(this.vertexAt(corner));
  }

  private turn(h: number, clockwise: boolean): void {
    const g = this.twin(h);
    const h1 = next(h), h2 = prev(h), g1 = next(g), g2 = prev(g);
    const a = this.vertexAt(h), b = this.vertexAt(g), c = this.vertexAt(h2), d = this.vertexAt(g2);
    const t1 = this.twin(h1), t2 = this.twin(h2), u1 = this.twin(g1), u2 = this.twin(g2);
    const put = (corner: number, vertex: number): void => {
      this.seat(corner, vertex);
      this.cornerOf[vertex] = corner;
    };
    if (clockwise) {
      put(h1, d);
      put(h2, b);
      put(g1, c);
      put(g2, a);
      put(h, c);
      put(g, d);
      this.join(h1, u2);
      this.join(h2, t1);
      this.join(g1, t2);
      this.join(g2, u1);
    } else {
      put(h1, c);
      put(h2, a);
      put(g1, d);
      put(g2, b);
      put(h, d);
      put(g, c);
      this.join(h1, t2);
      this.join(h2, u1);
      this.join(g1, u2);
      this.join(g2, t1);
    }
  }

  /** `place`: three numbers. Room must have been made. */
  move(v: number, place: Float64Array): void {
    if (v >= this.vertexCount || v < this.ghosts) throw new CorruptError(`a move of vertex ${v}`);
    this.remember(v);
    this.place(v, place, 0);
    this.edited[this.editedCount++] = v;
    this.applied[this.records++] = Kind.Move;
    this.touched?.(v);
  }

  private undoLast(keep: boolean): void {
    const { undone } = this;
    const kind = this.applied[--this.records]!;
    if (kind === Kind.Split) {
      this.undoSplit(keep);
      return;
    }
    const edited = this.edited[--this.editedCount]!;
    if (keep) undone.push(kind, edited, 0);
    if (kind === Kind.Flip) {
      this.turn(edited, false);
      this.touchQuad(edited);
    } else {
      if (keep) undone.keepPlace(0, this.positions, edited);
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
    if (kind === Kind.Split) this.split(a, b, undone.places());
    else if (kind === Kind.Flip) this.flip(a);
    else this.move(a, undone.places());
    undone.pop();
  }

  /** The mesh without ghosts, as new arrays. */
  visible(): { positions: Float64Array; indices: Uint32Array } {
    const positions = this.positions.slice(3 * this.ghosts, 3 * this.vertexCount);
    if (this.ghosts === 0) return { positions, indices: this.corners() };
    const indices: number[] = [];
    for (let h = 0; h < 3 * this.faceCount; h += 3) {
      const a = this.vertexAt(h), b = this.vertexAt(h + 1), c = this.vertexAt(h + 2);
      if (Math.min(a, b, c) >= this.ghosts) indices.push(a - this.ghosts, b - this.ghosts, c - this.ghosts);
    }
    return { positions, indices: Uint32Array.from(indices) };
  }
}
