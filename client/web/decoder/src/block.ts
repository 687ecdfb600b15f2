import { bitWidth, Column, ColumnReader, fromZigzag, lowBits } from "./columns.js";
import { crc32c } from "./crc32c.js";
import { CorruptError } from "./errors.js";
import { codesOf, Encoding, largestCoordinate, type Codes, type Grid } from "./grid.js";
import { Kind, type ProgressiveMesh } from "./mesh.js";
import { Star } from "./star.js";

/** A `vsplit.v1.RecordBlock`. */
export interface RecordBlock {
  first: number;
  count: number;
  encoding: number;
  payload: Uint8Array;
  crc32c: number;
}

const mostBlockBytes = 256 * 1024;
const mostBlockRecords = 65536;
const mostUnpackedBytes = 64;
const beside = 128;
const mostCodedFan = 10;
/** In the first byte of a payload, above the bits a coordinate. */
const layoutBit = 5;
const newestLayout = 1;
const isMean = 255;

/** Decodes blocks onto a mesh, one after the other: the counterpart of core's RecordCodec. */
export class RecordDecoder {
  private readonly codes: Codes | undefined;
  private readonly star = new Star();
  private readonly besideList = new Uint32Array(beside);
  private besideCount = 0;
  private lastMoved = -1;
  private columns!: ColumnReader;
  private inRange = true;
  /** Layout 1: points that are the mean of their ring say only that, and places have two columns. */
  private knowsMeans = false;
  private readonly point = new Float64Array(3);
  private readonly centre = new Float64Array(3);
  private readonly guess = new Float64Array(3);

  constructor(readonly grid: Grid) {
    this.codes = grid.encoding === Encoding.Float64 ? undefined : codesOf(grid);
  }

  /**
   * `mesh` stands where the block begins and takes its records.
   * Throws CorruptError that names the block by its first record; the mesh then is as it was.
   */
  decode(block: RecordBlock, mesh: ProgressiveMesh): void {
    const before = mesh.records;
    try {
      this.check(block);
      if (block.encoding === Encoding.Float64) decodePlain(block, mesh);
      else this.decodeCompact(block, mesh);
    } catch (error) {
      mesh.rewind(before);
      if (!(error instanceof CorruptError)) throw error;
      throw new CorruptError(`record block from record ${block.first} on: ${error.message}`);
    }
  }

  private check(block: RecordBlock): void {
    if (block.encoding !== this.grid.encoding) throw new CorruptError(`its encoding is ${block.encoding}, that of the base mesh was ${this.grid.encoding}`);
    if (block.payload.length > mostBlockBytes) throw new CorruptError(`${block.payload.length} bytes are more than ${mostBlockBytes}`);
    if (block.first + block.count > 0xffffffff) throw new CorruptError("record numbers go beyond 32 bits");
    if (crc32c(block.payload) !== block.crc32c >>> 0) throw new CorruptError("the CRC-32C does not fit the payload");
  }

  private decodeCompact(block: RecordBlock, mesh: ProgressiveMesh): void {
    if (block.count > mostBlockRecords) throw new CorruptError(`${block.count} records are more than ${mostBlockRecords}`);
    const header = block.payload[0] ?? 0xff;
    const layout = header >> layoutBit;
    if (header % (1 << layoutBit) !== this.grid.bits) throw new CorruptError(`it is not of ${this.grid.bits} bits a coordinate`);
    if (layout > newestLayout) throw new CorruptError(`its layout is ${layout}; this program reads layouts up to ${newestLayout}`);
    this.knowsMeans = layout > 0;
    const columns = (this.columns = new ColumnReader(block.payload.subarray(1), block.count * mostUnpackedBytes));
    const kinds = columns.take(Column.Kinds);
    if (kinds.length !== block.count) throw new CorruptError(`${kinds.length} kinds of records for a count of ${block.count}`);
    let splits = 0;
    for (const kind of kinds) splits += kind === Kind.Split ? 1 : 0;
    mesh.reserve(splits, kinds.length - splits);
    this.besideCount = 0;
    this.lastMoved = -1;
    this.inRange = true;
    for (let n = 0; n < kinds.length; ++n) {
      const kind = kinds[n]!;
      if (kind === Kind.Split) this.split(mesh);
      else if (kind === Kind.Flip) this.flip(mesh);
      else if (kind === Kind.Move) this.move(mesh);
      else throw new CorruptError(`record ${block.first + n} is of kind ${kind}`);
      if (columns.short) throw new CorruptError(`record ${block.first + n}: its columns are too short`);
    }
    if (!columns.allRead()) throw new CorruptError("something is left over behind the last record");
  }

  private place(mesh: ProgressiveMesh): number {
    const odd = this.knowsMeans && bitWidth(mesh.vertexCount) % 2 === 1;
    const symbol = this.columns.byte(odd ? Column.OddPlace : Column.Place);
    if (symbol >= beside) {
      if (symbol - beside >= this.besideCount) throw new CorruptError("a vertex that is not there");
      return this.besideList[symbol - beside]!;
    }
    const low = lowBits(mesh.vertexCount);
    const vertex = ((symbol << low) | this.columns.placeBits(low)) >>> 0;
    if (vertex >= mesh.vertexCount) throw new CorruptError("a vertex that is not there");
    return vertex;
  }

  private split(mesh: ProgressiveMesh): void {
    const { star, columns } = this;
    const vertex = this.place(mesh);
    star.gather(mesh, vertex);
    const valence = star.valence;
    let turn: number;
    let more: number;
    if (valence >= 3 && valence <= mostCodedFan) {
      const symbol = columns.byte(Column.Fan + valence);
      more = symbol % (valence - 1);
      turn = (symbol - more) / (valence - 1);
    } else {
      turn = columns.number(Column.LargeFan);
      more = columns.number(Column.LargeFan);
    }
    if (turn >= valence || more + 1 >= valence) throw new CorruptError("a fan that is none of the vertex");
    star.turn(turn);
    const steps = more + 1;
    const anchor = star.corner[star.first]!;

    star.lie();
    const { x, y, z, hasPlane } = star;
    let fx = 0, fy = 0, fz = 0, rx = 0, ry = 0, rz = 0;
    for (let n = 0; n <= steps; ++n) {
      fx += x[n]!;
      fy += y[n]!;
      fz += z[n]!;
    }
    const ex = (x[0]! + x[steps]!) * 0.5, ey = (y[0]! + y[steps]!) * 0.5, ez = (z[0]! + z[steps]!) * 0.5;
    for (let n = steps; n <= valence; ++n) {
      rx += x[n]!;
      ry += y[n]!;
      rz += z[n]!;
    }
    const inFan = steps + 1, inRest = valence - steps + 1;
    fx /= inFan;
    fy /= inFan;
    fz /= inFan;
    rx /= inRest;
    ry /= inRest;
    rz /= inRest;
    const fanHeight = hasPlane ? star.height(fx, fy, fz) : 0;
    const restHeight = hasPlane ? star.height(rx, ry, rz) : 0;
    const endsHeight = hasPlane ? star.height(ex, ey, ez) : 0;
    const { guess, point } = this;
    guess[0] = 0.5 * fx - 0.2 * rx + 0.15 * ex;
    guess[1] = 0.5 * fy - 0.2 * ry + 0.15 * ey;
    guess[2] = 0.5 * fz - 0.2 * rz + 0.15 * ez;
    // Of the new vertex, as far as it is known; where it is the mean of its ring the other one comes first.
    let ax = guess[0]!, ay = guess[1]!, az = guess[2]!, addedHeight = 0.35 * fanHeight - 0.15 * restHeight + 0.1 * endsHeight;
    const addedIsMean = this.skipMean();
    if (!addedIsMean) {
      this.codePoint(addedHeight, Column.Along, Column.Across);
      ax = point[0]! - star.cx;
      ay = point[1]! - star.cy;
      az = point[2]! - star.cz;
      addedHeight = hasPlane ? star.height(ax, ay, az) : 0;
    }
    let px = point[0]!, py = point[1]!, pz = point[2]!;
    if (!addedIsMean && this.skipMean()) {
      this.codeMean((rx * inRest + ax) / (inRest + 1), (ry * inRest + ay) / (inRest + 1), (rz * inRest + az) / (inRest + 1));
    } else {
      guess[0] = 0.55 * rx - 0.4 * fx + 0.1 * ex + 0.4 * ax;
      guess[1] = 0.55 * ry - 0.4 * fy + 0.1 * ey + 0.4 * ay;
      guess[2] = 0.55 * rz - 0.4 * fz + 0.1 * ez + 0.4 * az;
      this.codePoint(0.5 * restHeight - 0.35 * fanHeight + 0.05 * endsHeight + 0.4 * addedHeight, Column.Along, Column.Across);
    }
    const kx = point[0]!, ky = point[1]!, kz = point[2]!;
    if (addedIsMean) {
      ax = kx - star.cx;
      ay = ky - star.cy;
      az = kz - star.cz;
      this.codeMean((fx * inFan + ax) / (inFan + 1), (fy * inFan + ay) / (inFan + 1), (fz * inFan + az) / (inFan + 1));
      px = point[0]!;
      py = point[1]!;
      pz = point[2]!;
    }
    if (!this.inRange) throw new CorruptError("a position that is not on the grid");
    const added = mesh.vertexCount;
    mesh.split(anchor, steps, kx, ky, kz, px, py, pz);
    this.noteBeside(vertex, added);
    this.lastMoved = -1;
  }

  private noteBeside(vertex: number, added: number): void {
    const { besideList, star } = this;
    besideList[0] = vertex;
    besideList[1] = added;
    const most = Math.min(star.valence, beside - 2);
    for (let n = 0, at = star.first; n < most; ++n, at = at + 1 === star.valence ? 0 : at + 1) besideList[n + 2] = star.vertex[at]!;
    this.besideCount = most + 2;
  }

  private flip(mesh: ProgressiveMesh): void {
    const half = this.columns.uniform(Column.Flip, 3 * mesh.faceCount);
    mesh.flip(half);
    this.besideCount = 0;
    for (const side of [half, mesh.twins[half]!]) {
      this.besideList[this.besideCount++] = mesh.corners[side]!;
      this.besideList[this.besideCount++] = mesh.corners[side % 3 === 0 ? side + 2 : side - 1]!;
    }
    this.lastMoved = -1;
  }

  private move(mesh: ProgressiveMesh): void {
    const step = this.columns.number(Column.Moved);
    const vertex = (this.lastMoved + 1 + fromZigzag(step)) >>> 0;
    if (vertex >= mesh.vertexCount) throw new CorruptError("a vertex that is not there");
    this.lastMoved = vertex;
    this.star.gather(mesh, vertex);
    this.star.lie();
    this.guess.fill(0);
    this.codePoint(0, Column.MoveAlong, Column.MoveAcross);
    if (!this.inRange) throw new CorruptError("a position that is not on the grid");
    mesh.move(vertex, this.point[0]!, this.point[1]!, this.point[2]!);
  }

  /** Whether a point of a split is the mean of its ring, but for what column Mean says. */
  private skipMean(): boolean {
    if (!this.knowsMeans) return false;
    const { star } = this;
    const u = star.across === 2 ? 0 : star.across + 1;
    const centre = u === 0 ? star.cx : u === 1 ? star.cy : star.cz;
    return this.columns.skip(Column.Along + this.codes!.scale(star.reach[u]!, centre), isMean);
  }

  /** The offset of the mean from the centre. */
  private codeMean(dx: number, dy: number, dz: number): void {
    const { star, point } = this;
    const codes = this.codes!;
    const off = this.columns.byte(Column.Mean);
    point[0] = codes.decode(star.cx + dx, Math.trunc(off / 9) - 1, 0);
    point[1] = codes.decode(star.cy + dy, (Math.trunc(off / 3) % 3) - 1, 1);
    point[2] = codes.decode(star.cz + dz, (off % 3) - 1, 2);
    this.inRange &&= off < 27 && !Number.isNaN(point[0]! + point[1]! + point[2]!);
  }

  private codePoint(height: number, along: number, across: number): void {
    const { star, centre, guess, point } = this;
    const codes = this.codes!;
    centre[0] = star.cx;
    centre[1] = star.cy;
    centre[2] = star.cz;
    const w = star.across;
    const u = w === 2 ? 0 : w + 1;
    const v = u === 2 ? 0 : u + 1;
    this.put(along + codes.scale(star.reach[u]!, centre[u]!), centre[u]! + guess[u]!, u);
    this.put(along + codes.scale(star.reach[v]!, centre[v]!), centre[v]! + guess[v]!, v);
    if (!star.hasPlane) {
      this.put(along + codes.scale(star.reach[w]!, centre[w]!), centre[w]! + guess[w]!, w);
      return;
    }
    const { normal } = star;
    const slope = (normal[u]! * (point[u]! - centre[u]!) + normal[v]! * (point[v]! - centre[v]!)) / normal[w]!;
    this.put(across + codes.scale(star.thickness, centre[w]!), centre[w]! - slope + height, w);
  }

  private put(column: number, expected: number, axis: number): void {
    if (!this.inRange) return;
    const value = this.codes!.decode(expected, fromZigzag(this.columns.number(column)), axis);
    this.point[axis] = value;
    this.inRange = value === value;
  }
}

/** Encoding 1. */
function decodePlain(block: RecordBlock, mesh: ProgressiveMesh): void {
  const { payload, count } = block;
  const padded = Math.ceil(count / 8) * 8;
  if (padded > payload.length) throw new CorruptError(`${count} records take at least ${padded} bytes, and there are ${payload.length}`);
  const counts = [0, 0, 0];
  for (let n = 0; n < count; ++n) {
    if (payload[n]! > Kind.Move) throw new CorruptError(`record ${block.first + n} is of kind ${payload[n]}`);
    ++counts[payload[n]!]!;
  }
  for (let n = count; n < padded; ++n) {
    if (payload[n] !== 0) throw new CorruptError("the bytes that fill up the kinds are not 0");
  }
  const [splits, flips, moves] = counts as [number, number, number];
  if (padded + 56 * splits + 4 * flips + 28 * moves !== payload.length) throw new CorruptError(`it is ${payload.length} bytes long`);
  const view = new DataView(payload.buffer, payload.byteOffset, payload.length);
  let anchor = padded, steps = anchor + 4 * splits, kept = steps + 4 * splits, added = kept + 24 * splits;
  let position = added + 24 * splits, half = position + 24 * moves, vertex = half + 4 * flips;
  const f64 = (at: number): number => {
    const value = view.getFloat64(at, true);
    if (!(Math.abs(value) <= largestCoordinate)) throw new CorruptError("a coordinate is not finite or beyond 1e15");
    return value;
  };
  mesh.reserve(splits, flips + moves);
  for (let n = 0; n < count; ++n) {
    if (payload[n] === Kind.Split) {
      checkFan(mesh, view.getUint32(anchor, true), view.getUint32(steps, true));
      mesh.split(view.getUint32(anchor, true), view.getUint32(steps, true), f64(kept), f64(kept + 8), f64(kept + 16), f64(added), f64(added + 8), f64(added + 16));
      anchor += 4;
      steps += 4;
      kept += 24;
      added += 24;
    } else if (payload[n] === Kind.Flip) {
      mesh.flip(view.getUint32(half, true));
      half += 4;
    } else {
      mesh.move(view.getUint32(vertex, true), f64(position), f64(position + 8), f64(position + 16));
      vertex += 4;
      position += 24;
    }
  }
}

function checkFan(mesh: ProgressiveMesh, anchor: number, steps: number): void {
  if (anchor >= 3 * mesh.faceCount) throw new CorruptError(`anchor ${anchor} is no corner`);
  if (steps === 0) throw new CorruptError("0 steps");
  let corner = anchor;
  for (let n = 0; n < steps; ++n) {
    corner = mesh.twins[corner % 3 === 0 ? corner + 2 : corner - 1]!;
    if (corner === anchor) throw new CorruptError(`${steps} steps around a vertex of valence ${n + 1}`);
  }
}
