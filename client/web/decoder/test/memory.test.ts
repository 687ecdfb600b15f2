import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { setFlagsFromString } from "node:v8";
import { runInNewContext } from "node:vm";
import { CorruptError, crc32c, ProgressiveMesh, RecordDecoder, unpackBase, float32Grid } from "../src/index.js";
import { readGolden, type Golden } from "./golden.js";

// dist/test/ stands under client/web/decoder/.
const stream = (name: string): Golden => readGolden(readFileSync(new URL(`../../../../../tests/data/golden/${name}.golden`, import.meta.url), "utf8"));

/** Two tips over and under a ring of so many vertices. */
function bipyramid(sides: number): [Float64Array, Uint32Array] {
  const positions = [0, 0, 1, 0, 0, -1], corners: number[] = [];
  for (let n = 0; n < sides; ++n) {
    const angle = (2 * Math.PI * n) / sides, here = 2 + n, there = 2 + ((n + 1) % sides);
    positions.push(Math.cos(angle), Math.sin(angle), 0);
    corners.push(0, here, there, 1, there, here);
  }
  return [Float64Array.from(positions), Uint32Array.from(corners)];
}

test("positions are those of the mesh after it has grown, whatever became of its memory", () => {
  const { base, grid, blocks } = stream("records_2_float32_improved");
  const mesh = new ProgressiveMesh(base.positions, base.corners, base.ghosts);
  const decoder = new RecordDecoder(grid);
  let moved = 0;
  for (const { block } of blocks) {
    const before = mesh.positions;
    mesh.foresee(64 * mesh.vertexCount);
    decoder.decode(block, mesh);
    moved += before.length === 0 ? 1 : 0;
    assert.equal(mesh.positions.length, 3 * mesh.vertexCount);
    assert.ok(mesh.positions.every((value) => Math.abs(value) < 1e6));
    assert.equal(mesh.corners().length, 3 * mesh.faceCount);
  }
  assert.ok(moved > 0, "memory never grew, so this tests nothing");
});

test("the arrays of a base mesh are copied", () => {
  const [positions, corners] = bipyramid(5);
  const mesh = new ProgressiveMesh(positions, corners);
  positions.fill(7);
  corners.fill(7);
  assert.deepEqual([...mesh.positions.subarray(0, 3), mesh.vertexAt(1), mesh.vertexAt(2)], [0, 0, 1, 2, 3]);
});

test("meshes know nothing of each other", () => {
  const meshes = Array.from({ length: 200 }, (_, n) => new ProgressiveMesh(...bipyramid(3 + n)));
  meshes.forEach((mesh, n) => assert.deepEqual([mesh.vertexCount, mesh.faceCount], [5 + n, 6 + 2 * n]));
});

test("the memory of meshes that nobody knows any more is given back", async () => {
  setFlagsFromString("--expose-gc");
  const collect = runInNewContext("gc") as () => void;
  const held = (): number => process.memoryUsage().arrayBuffers + process.memoryUsage().external;
  const [positions, corners] = bipyramid(20_000);
  const make = (): number => new ProgressiveMesh(positions, corners).positions.buffer.byteLength;
  const one = make();
  assert.ok(one > 2 ** 20);
  collect();
  const before = held();
  for (let n = 0; n < 50; ++n) {
    make();
    if (n % 10 !== 9) continue;
    await new Promise((resolve) => setTimeout(resolve, 0));
    collect();
  }
  assert.ok(held() < before + 10 * one, `${held() - before} bytes of 50 meshes of ${one} each are held`);
});

test("a mesh that is none is refused", () => {
  const [positions, corners] = bipyramid(4);
  const refused = (change: () => unknown, what: RegExp): void =>
    assert.throws(change, (error: Error) => error instanceof CorruptError && what.test(error.message));
  refused(() => new ProgressiveMesh(positions, corners.subarray(3)), /^the base mesh: the mesh is open/);
  refused(() => new ProgressiveMesh(positions, corners.map((v) => v + 1)), /^the base mesh: .*names vertex 6 of 6/);
  refused(() => new ProgressiveMesh(positions.map((value) => value / 0), corners), /^the base mesh: .*not finite/);
  refused(() => new ProgressiveMesh(positions, corners, 7), /^the base mesh: 7 ghosts among 6 vertices/);
  refused(() => new ProgressiveMesh(new Float64Array(), new Uint32Array()), /^the base mesh: /);
  refused(() => unpackBase(new Uint8Array(), { vertices: 4, faces: 4, ghosts: 0 }, float32Grid), /^packed base mesh: /);
});

test("what a base mesh merely announces is no reason to take memory, or is refused for lack of it", () => {
  const counts = { vertices: 0xffffffff, faces: 0xffffffff, ghosts: 0 };
  const packed = Uint8Array.of(0, 0, 0, 3, 0x28, 0xb5, 0x2f);
  assert.throws(() => unpackBase(packed, counts, float32Grid), CorruptError);
  // Column 0 of two bytes as they are, and a frame of column 1 that announces many and has none.
  const frame = (...size: number[]): Uint8Array => Uint8Array.of(0, 0, 0, 4, 9, 9, 1, 19, 0x28, 0xb5, 0x2f, 0xfd, 0xa0, ...size);
  const larger = { vertices: 0xaaaaaa, faces: 0xaaaaaaa, ghosts: 0 };
  for (const of of [counts, larger, { ...larger, vertices: 0x15555555 }]) {
    assert.throws(() => unpackBase(frame(0xf6, 0xff, 0xff, 0xff), of, float32Grid), CorruptError);
    assert.throws(() => unpackBase(frame(0xf0, 0xff, 0xff, 0x6f), of, float32Grid), (error: Error) => error instanceof CorruptError || error instanceof RangeError);
  }
  assert.equal(crc32c(new TextEncoder().encode("123456789")), 0xe3069283, "others go on");
});

test("the checksum of much is that of its parts", () => {
  const bytes = Uint8Array.from({ length: 200_000 }, (_, n) => (n * n) >> 3);
  let bit = 0xffffffff; // bit by bit
  for (const byte of bytes) {
    bit ^= byte;
    for (let n = 0; n < 8; ++n) bit = (bit >>> 1) ^ (bit & 1 ? 0x82f63b78 : 0);
  }
  assert.equal(crc32c(bytes), ~bit >>> 0);
});
