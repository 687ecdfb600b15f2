import { bitWidth, Column, ColumnReader, fromZigzag, lowBits } from "./columns.js";
import { crc32c } from "./crc32c.js";
import { CorruptError } from "./errors.js";
import { codesOf, Encoding, largestCoordinate, type Codes, type Grid } from "./grid.js";
import { Guess, height } from "./guess.js";
import { LookAhead } from "./look_ahead.js";
import { Kind, next, prev, type ProgressiveMesh } from "./mesh.js";
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
/** Steps of the grid along x, y and z from a mean, by what column Mean says. */
const nearMean = Int32Array.from({ length: 81 }, (_, n) => (Math.floor(Math.floor(n / 3) / [9, 3, 1][n % 3]!) % 3) - 1);

/** Decodes blocks onto a mesh, one after the other: the counterpart of core's RecordCodec. */
export class RecordDecoder {
  private readonly codes: Codes | undefined;
  private readonly guess = new Guess();
  private readonly lookAhead = new LookAhead();
  private columns!: ColumnReader;
  /** Layout 1: points that are the mean of their ring say only that, and places have two columns. */
  private knowsMeans = false;
  /** Of the splits of a block: vertices, or ~n for the n-th beside the record before. */
  private places = new Int32Array(1024);
  private placesRead = 0;
  private placesTaken = 0;

  /** What is beside the record before: some vertices, then so many of the ring of the last split. */
  private readonly besideFirst = new Int32Array(4);
  private besideFirstCount = 0;
  private besideRingCount = 0;
  private readonly splitStar = new Star();
  private readonly moveStar = new Star();
  private lastMoved = -1;

  // Of the point that is read: scales of its columns, what is expected of it, what is read.
  private readonly scales = new Int32Array(4);
  private readonly guessed = new Float64Array(4);
  private readonly expected = new Float64Array(3);
  private readonly mean = new Float64Array(3);
  private readonly point = new Float64Array(3);
  /** Of a split or move, as ProgressiveMesh takes them. */
  private readonly points = new Float64Array(6);

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
    for (let n = 0; n < kinds.length; ++n) splits += kinds[n] === Kind.Split ? 1 : 0;
    mesh.reserve(splits, kinds.length - splits);
    this.readPlaces(splits, mesh.vertexCount);
    this.besideFirstCount = 0;
    this.besideRingCount = 0;
    this.lastMoved = -1;
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

  /** All at once, so that the mesh around those that come can be looked at ahead. */
  private readPlaces(splits: number, vertices: number): void {
    const { columns, knowsMeans } = this;
    if (splits > this.places.length) this.places = new Int32Array(splits);
    const { places } = this;
    for (let n = 0; n < splits; ++n) {
      const odd = knowsMeans && bitWidth(vertices + n) % 2 === 1;
      const symbol = columns.byte(odd ? Column.OddPlace : Column.Place), low = lowBits(vertices + n);
      places[n] = symbol >= beside ? ~(symbol - beside) : (symbol << low) | columns.placeBits(low);
    }
    if (columns.short) throw new CorruptError(`the columns of places are too short for ${splits} splits`);
    this.placesRead = splits;
    this.placesTaken = 0;
    this.lookAhead.begin();
  }

  /** Gathers the star of the next split's vertex. */
  private nextStar(mesh: ProgressiveMesh): number {
    const { places, placesRead } = this;
    const n = this.placesTaken++;
    this.lookAhead.reach(n, mesh, places, placesRead);
    const place = places[n]! | 0;
    const corner = place < 0 ? this.cornerBeside(~place, mesh) : place < mesh.vertexCount ? mesh.cornerOf[place]! | 0 : -1;
    if (corner < 0) throw new CorruptError("a vertex that is not there");
    const vertex = place < 0 ? mesh.vertexAt(corner) : place;
    this.splitStar.gather(mesh, vertex, corner);
    return vertex;
  }

  /** A corner at the n-th vertex beside the record before; -1 where there are not so many. */
  private cornerBeside(n: number, mesh: ProgressiveMesh): number {
    if (n < this.besideFirstCount) return mesh.cornerOf[this.besideFirst[n]!]!;
    const inRing = n - this.besideFirstCount;
    return inRing < this.besideRingCount ? next(this.splitStar.corner(inRing)) : -1;
  }

  private split(mesh: ProgressiveMesh): void {
    const { splitStar: star, guess, points, besideFirst } = this;
    const vertex = this.nextStar(mesh);
    const steps = this.fan(star);
    star.lie(steps);
    this.codes!.scales(star, this.scales);
    guess.begin(star, steps);
    this.readPoints(star);
    besideFirst[0] = vertex;
    besideFirst[1] = mesh.vertexCount;
    mesh.split(star.corner(0), steps, points);
    this.besideFirstCount = 2;
    this.besideRingCount = Math.min(star.valence, beside - 2);
    this.lastMoved = -1;
  }

  /** Of a split, into `points`. Where the new vertex is the mean of its ring, the old one comes first. */
  private readPoints(star: Star): void {
    const { guess, guessed, points } = this;
    guess.forAdded(guessed);
    const addedIsMean = this.isMeanNext(star);
    if (!addedIsMean) {
      this.readPoint(star, Column.Along, Column.Across, 3);
      guess.addedIs(star, points);
      if (this.isMeanNext(star)) {
        guess.meanAroundKept(this.mean, star, points);
        return this.readNearMean(star, 0);
      }
    }
    guess.forKept(guessed);
    this.readPoint(star, Column.Along, Column.Across, 0);
    if (!addedIsMean) return;
    guess.meanAroundAdded(this.mean, star, points);
    this.readNearMean(star, 3);
  }

  /** Whether a point is the mean of its ring, but for what column Mean says: this is written in place of its first number. */
  private isMeanNext({ across }: Star): boolean {
    return this.knowsMeans && this.columns.skip(Column.Along + this.scales[across === 2 ? 0 : across + 1]!, isMean);
  }

  /** At most a step of the grid from the mean in each direction, into `points` from `to` on. */
  private readNearMean({ centre }: Star, to: number): void {
    const { codes, mean, points } = this;
    const off = this.columns.byte(Column.Mean);
    if (off >= 27) throw new CorruptError("a position that is not on the grid");
    for (let axis = 0; axis < 3; ++axis) {
      const value = codes!.decode(centre[axis]! + mean[axis]!, nearMean[3 * off + axis]!, axis);
      if (value !== value) throw new CorruptError("a position that is not on the grid");
      points[to + axis] = value;
    }
  }

  /** How many faces go over; the star is turned to the first of them. */
  private fan(star: Star): number {
    const { columns } = this;
    const { valence } = star;
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
    return more + 1;
  }

  private flip(mesh: ProgressiveMesh): void {
    const { besideFirst } = this;
    const half = this.columns.uniform(Column.Flip, 3 * mesh.faceCount);
    const twin = mesh.flip(half);
    besideFirst[0] = mesh.vertexAt(half);
    besideFirst[1] = mesh.vertexAt(prev(half));
    besideFirst[2] = mesh.vertexAt(twin);
    besideFirst[3] = mesh.vertexAt(prev(twin));
    this.besideFirstCount = 4;
    this.besideRingCount = 0;
    this.lastMoved = -1;
  }

  private move(mesh: ProgressiveMesh): void {
    const { moveStar: star, guessed } = this;
    const step = this.columns.number(Column.Moved);
    const vertex = (this.lastMoved + 1 + fromZigzag(step)) >>> 0;
    if (vertex >= mesh.vertexCount) throw new CorruptError("a vertex that is not there");
    this.lastMoved = vertex;
    star.gather(mesh, vertex, mesh.cornerOf[vertex]!);
    star.lie(0);
    this.codes!.scales(star, this.scales);
    guessed.fill(0);
    this.readPoint(star, Column.MoveAlong, Column.MoveAcross, 0);
    mesh.move(vertex, this.points);
  }

  /** Near where it was guessed, into `points` from `to` on. */
  private readPoint({ centre, normal, across: w, hasPlane }: Star, along: number, across: number, to: number): void {
    const { scales, guessed, expected, point, points } = this;
    const u = w === 2 ? 0 : w + 1;
    const v = u === 2 ? 0 : u + 1;
    expected[u] = centre[u]! + guessed[u]!;
    expected[v] = centre[v]! + guessed[v]!;
    this.readCoordinate(along + scales[u]!, u);
    this.readCoordinate(along + scales[v]!, v);
    if (hasPlane) {
      const slope = (normal[u]! * (point[u]! - centre[u]!) + normal[v]! * (point[v]! - centre[v]!)) / normal[w]!;
      expected[w] = centre[w]! - slope + guessed[height]!;
      this.readCoordinate(across + scales[3]!, w);
    } else {
      expected[w] = centre[w]! + guessed[w]!;
      this.readCoordinate(along + scales[w]!, w);
    }
    points[to] = point[0]!;
    points[to + 1] = point[1]!;
    points[to + 2] = point[2]!;
  }

  private readCoordinate(column: number, axis: number): void {
    const value = this.codes!.decode(this.expected[axis]!, fromZigzag(this.columns.number(column)), axis);
    if (value !== value) throw new CorruptError("a position that is not on the grid");
    this.point[axis] = value;
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
  const points = new Float64Array(6);
  const read = (to: number, at: number): void => {
    for (let axis = 0; axis < 3; ++axis) {
      const value = view.getFloat64(at + 8 * axis, true);
      if (!(Math.abs(value) <= largestCoordinate)) throw new CorruptError("a coordinate is not finite or beyond 1e15");
      points[to + axis] = value;
    }
  };
  mesh.reserve(splits, flips + moves);
  for (let n = 0; n < count; ++n) {
    if (payload[n] === Kind.Split) {
      checkFan(mesh, view.getUint32(anchor, true), view.getUint32(steps, true));
      read(0, kept);
      read(3, added);
      mesh.split(view.getUint32(anchor, true), view.getUint32(steps, true), points);
      anchor += 4;
      steps += 4;
      kept += 24;
      added += 24;
    } else if (payload[n] === Kind.Flip) {
      mesh.flip(view.getUint32(half, true));
      half += 4;
    } else {
      read(0, position);
      mesh.move(view.getUint32(vertex, true), points);
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
    corner = mesh.after(corner);
    if (corner === anchor) throw new CorruptError(`${steps} steps around a vertex of valence ${n + 1}`);
  }
}
