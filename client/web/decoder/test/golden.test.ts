import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import { test } from "node:test";
import { CorruptError, crc32c, Encoding, ProgressiveMesh, RecordDecoder, type Grid, type RecordBlock } from "../src/index.js";
import { readGolden, type Golden } from "./golden.js";

// dist/test/ stands under client/web/decoder/.
const directory = new URL("../../../../../tests/data/golden/", import.meta.url);

interface Opened {
  base: ProgressiveMesh;
  grid: Grid;
  blocks: Golden["blocks"];
}

function read(name: string): Opened {
  const { base, grid, blocks } = readGolden(readFileSync(new URL(name, directory), "utf8"));
  return { base: new ProgressiveMesh(base.positions, base.corners, base.ghosts), grid, blocks };
}

const bytesIn = (array: Float64Array | Uint32Array): Uint8Array => new Uint8Array(array.buffer, array.byteOffset, array.byteLength);

function state(mesh: ProgressiveMesh): string {
  const positions = mesh.positions.slice(0, 3 * mesh.vertexCount);
  const corners = mesh.corners();
  return `${mesh.vertexCount} ${mesh.faceCount} ${crc32c(bytesIn(positions))} ${crc32c(bytesIn(corners))}`;
}

test("room for splits that are foreseen is made once, and never for any number", () => {
  const { base: mesh, grid, blocks } = read("records_1_quantised14_closed.golden");
  const records = blocks.reduce((sum, { block }) => sum + block.count, 0);
  mesh.foresee(records);
  const at = mesh.positions.byteOffset;
  const decoder = new RecordDecoder(grid);
  for (const { block } of blocks) decoder.decode(block, mesh);
  assert.equal(mesh.positions.byteOffset, at);
  assert.equal(state(mesh), blocks.at(-1)!.after);

  const { base: claimed } = read("records_1_quantised14_closed.golden");
  claimed.foresee(0xffffffff);
  assert.ok(claimed.positions.buffer.byteLength <= 2 ** 20 + 65 * 256 * claimed.vertexCount);
});

const names = readdirSync(directory).filter((name) => name.endsWith(".golden"));

test("there are golden files of every encoding", () => assert.ok(names.length >= 6));

for (const name of names) {
  test(`${name} decodes to the meshes that C++ made, and back`, () => {
    const { base, grid, blocks } = read(name);
    const before = state(base);
    const decoder = new RecordDecoder(grid);
    for (const { block, after } of blocks) {
      decoder.decode(block, base);
      assert.equal(state(base), after);
    }
    base.rewind(0);
    assert.equal(state(base), before);
    for (const { block } of blocks) decoder.decode(block, base);
    assert.equal(state(base), blocks.at(-1)!.after);
  });

  test(`${name}: damage is refused by the block's first record and changes nothing`, () => {
    const { base, grid, blocks } = read(name);
    const decoder = new RecordDecoder(grid);
    decoder.decode(blocks[0]!.block, base);
    const before = state(base);
    const good = blocks[1]!.block;
    const refused = (block: RecordBlock): void => {
      assert.throws(() => decoder.decode(block, base), (error: Error) => error instanceof CorruptError && error.message.includes(`from record ${good.first} on`));
      assert.equal(state(base), before);
    };
    const turned = good.payload.slice();
    turned[turned.length >> 1]! ^= 1;
    refused({ ...good, payload: turned });
    const cut = good.payload.slice(0, -1);
    refused({ ...good, payload: cut });
    refused({ ...good, payload: cut, crc32c: crc32c(cut) });
    refused({ ...good, encoding: 17 });
    refused({ ...good, count: good.count + 1 });
    decoder.decode(good, base);
    assert.equal(state(base), blocks[1]!.after);
  });
}

/** Corners and places of every face, to compare one by one. */
function faceTexts(mesh: ProgressiveMesh): string[] {
  return Array.from({ length: mesh.faceCount }, (_, f) => {
    const corners = [0, 1, 2].map((c) => mesh.vertexAt(3 * f + c));
    return corners.map((v) => `${v}:${mesh.positions.subarray(3 * v, 3 * v + 3).join()}`).join(" ");
  });
}

for (const name of names) {
  test(`${name}: levels that were undone come back, and what changes is told`, () => {
    const { base, grid, blocks } = read(name);
    const decoder = new RecordDecoder(grid);
    for (const { block } of blocks) decoder.decode(block, base);
    const end = state(base), top = base.level, records = base.records;
    base.follow();
    const states = new Map<number, string>();
    let seed = 7;
    for (let round = 0; round < 40; ++round) {
      seed = (seed * 48271) % 2147483647;
      const level = seed % (top + 1);
      const before = faceTexts(base);
      if (level < base.level) base.coarsen(base.level - level);
      else base.refine(level);
      assert.equal(base.level, level);
      assert.equal(base.records + base.recordsUndone, records);
      const told = new Set(base.takeChanges());
      faceTexts(base).forEach((text, f) => assert.ok(text === before[f] || told.has(f), `face ${f} changed and was not told`));
      const now = level < top ? state(base) : "";
      if (states.has(level)) assert.equal(now, states.get(level));
      states.set(level, now);
    }
    base.refineAll();
    assert.equal(state(base), end);
  });
}

test("a grid whose step has no reciprocal is refused", () => {
  const grid = (step: number): Grid => ({ encoding: Encoding.Quantised, bits: 14, origin: [0, 0, 0], step });
  assert.throws(() => new RecordDecoder(grid(2 ** -1023)), CorruptError);
  assert.throws(() => new RecordDecoder(grid(0)), CorruptError);
  assert.ok(new RecordDecoder(grid(2 ** -1022)));
});

/** The payload of a block of encoding 2 or 3 without its columns of places: one, or two in layout 1. */
function withoutPlaces(payload: Uint8Array): Uint8Array {
  const places = payload[0]! < 32 ? [1] : [1, 2];
  const kept = [...payload.subarray(0, 1)];
  for (let at = 1; at < payload.length; ) {
    const begin = at;
    let size = 0, shift = 1, byte = 0x80;
    for (++at; byte >= 0x80; shift *= 128) size += ((byte = payload[at++]!) & 0x7f) * shift;
    at += size >> 1;
    if (!places.includes(payload[begin]!)) kept.push(...payload.subarray(begin, at));
  }
  assert.ok(kept.length < payload.length);
  return Uint8Array.from(kept);
}

for (const name of names.filter((name) => !name.includes("float64"))) {
  test(`${name}: a block without its places is refused, and nothing changes`, () => {
    const { base, grid, blocks } = read(name);
    const before = state(base);
    const payload = withoutPlaces(blocks[0]!.block.payload);
    const block = { ...blocks[0]!.block, payload, crc32c: crc32c(payload) };
    assert.throws(() => new RecordDecoder(grid).decode(block, base), /from record 0 on: record 0: its columns are too short/);
    assert.equal(state(base), before);
  });
}

test("no text is made of what is decoded", (context) => {
  const join = context.mock.method(Object.getPrototypeOf(Uint8Array.prototype) as Uint8Array, "join");
  for (const name of names) {
    const { base, grid, blocks } = read(name);
    const decoder = new RecordDecoder(grid);
    for (const { block } of blocks) decoder.decode(block, base);
  }
  assert.equal(join.mock.callCount(), 0);
});
