import { Column, ColumnReader, fromZigzag } from "./columns.js";
import { CorruptError } from "./errors.js";
import { codesOf, Encoding, type Codes, type Grid } from "./grid.js";
import { next, prev } from "./mesh.js";

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

const none = 0xffffffff;
const enum Third {
  New = 0,
  Right = 1,
  Left = 2,
  Named = 3,
}

/** The counterpart of core's unpack_base. */
export function unpackBase(bytes: Uint8Array, counts: BaseCounts, grid: Grid): BaseMesh {
  if (grid.encoding === Encoding.Float64) throw new CorruptError("packed base mesh: FLOAT64 is not packed");
  if (bytes.length < 2 || bytes[0] !== grid.bits || bytes[1]! > 1) throw new CorruptError("packed base mesh: its header is wrong");
  const columns = new ColumnReader(bytes.subarray(2), 24 * (counts.vertices + counts.faces));
  const reader = new BaseReader(columns, codesOf(grid), counts);
  if (bytes[1] === 0) reader.walk();
  else reader.plain();
  if (columns.short || !columns.allRead()) throw new CorruptError("packed base mesh: it does not make what was announced");
  return { positions: Float64Array.from(reader.positions), corners: Uint32Array.from(reader.corners) };
}

/** Arrays that grow with what is read, never with what is announced. */
class BaseReader {
  readonly positions: number[] = [];
  readonly corners: number[] = [];
  private readonly twins: number[] = [];
  private readonly halfEdges = new Map<number, number>();
  private gates: number[] = [];

  constructor(private readonly columns: ColumnReader, private readonly codes: Codes, private readonly counts: BaseCounts) {}

  private get known(): number {
    return this.positions.length / 3;
  }

  private require(good: boolean): void {
    if (!good || this.columns.short) throw new CorruptError("packed base mesh: it does not make what was announced");
  }

  private coordinate(column: number, expected: number, axis: number): number {
    const value = this.codes.decode(expected, fromZigzag(this.columns.number(column)), axis);
    this.require(value === value);
    return value;
  }

  plain(): void {
    const before = [0, 0, 0];
    for (let v = 0; v < this.counts.vertices; ++v) {
      for (let axis = 0; axis < 3; ++axis) {
        before[axis] = this.coordinate(Column.Along + axis, before[axis]!, axis);
        this.positions.push(before[axis]!);
      }
    }
    let last = 0;
    for (let n = 0; n < 3 * this.counts.faces; ++n) {
      last = (last + fromZigzag(this.columns.number(Column.Moved))) >>> 0;
      this.require(true);
      this.corners.push(last);
    }
  }

  walk(): void {
    const { vertices, faces, ghosts } = this.counts;
    while (this.known < ghosts) this.newVertexNearLast();
    while (this.corners.length < 3 * faces) {
      this.firstFace();
      while (this.gates.length > 0) {
        const gate = this.gates.pop()!;
        if (this.twins[gate] !== none) continue;
        this.require(this.corners.length < 3 * faces);
        this.faceBehind(gate);
      }
    }
    this.require(this.known === vertices);
  }

  private newVertexNearLast(): void {
    const from = this.positions.length - 3;
    const near = from < 0 ? [0, 0, 0] : this.positions.slice(from);
    this.newVertex(near as [number, number, number], 31, 1);
  }

  private newVertex(expected: [number, number, number], scale: number, length: number): void {
    this.require(this.known < this.counts.vertices);
    const made = [0, 0, 0];
    for (let axis = 0; axis < 3; ++axis) {
      const at = scale >= 0 ? scale : this.codes.scale(length, expected[axis]!);
      made[axis] = this.coordinate(Column.Along + at, expected[axis]!, axis);
    }
    this.positions.push(made[0]!, made[1]!, made[2]!);
    this.require(true);
  }

  private named(symbol: number): number {
    this.require(symbol === Third.Named && this.known > 0);
    const vertex = this.columns.uniform(Column.Place, this.known);
    this.require(vertex < this.known);
    return vertex;
  }

  private firstFace(): void {
    const face: number[] = [];
    for (let n = 0; n < 3; ++n) {
      const symbol = this.columns.byte(Column.Kinds);
      if (symbol === Third.New) {
        face.push(this.known);
        this.newVertexNearLast();
      } else {
        face.push(this.named(symbol));
      }
    }
    const first = this.add(face[0]!, face[1]!, face[2]!);
    this.gates.push(first, prev(first), next(first));
  }

  private faceBehind(gate: number): void {
    const { corners, positions } = this;
    const a = corners[next(gate)]!, b = corners[gate]!, d = corners[prev(gate)]!;
    const symbol = this.columns.byte(Column.Kinds);
    let c: number;
    if (symbol === Third.New) {
      c = this.known;
      const expected: [number, number, number] = [0, 0, 0];
      let length = 0;
      for (let axis = 0; axis < 3; ++axis) {
        const pa = positions[3 * a + axis]!, pb = positions[3 * b + axis]!;
        expected[axis] = pa + pb - positions[3 * d + axis]!;
        length = Math.max(length, Math.abs(pa - pb));
      }
      this.newVertex(expected, -1, length);
    } else if (symbol === Third.Right) {
      let h = gate;
      while (this.twins[prev(h)] !== none) h = this.twins[prev(h)]!;
      c = corners[prev(h)]!;
    } else if (symbol === Third.Left) {
      let h = gate;
      while (this.twins[next(h)] !== none) h = this.twins[next(h)]!;
      c = corners[prev(h)]!;
    } else {
      c = this.named(symbol);
    }
    const first = this.add(a, b, c);
    this.gates.push(prev(first), next(first));
  }

  private add(a: number, b: number, c: number): number {
    const first = this.corners.length;
    this.corners.push(a, b, c);
    this.twins.push(none, none, none);
    const pairs = [[a, b], [b, c], [c, a]] as const;
    pairs.forEach(([from, to], n) => {
      const h = first + n;
      const key = from * this.counts.vertices + to;
      this.require(!this.halfEdges.has(key));
      this.halfEdges.set(key, h);
      const back = this.halfEdges.get(to * this.counts.vertices + from);
      if (back === undefined) return;
      this.twins[h] = back;
      this.twins[back] = h;
    });
    return first;
  }
}
