import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import { test } from "node:test";
import { CorruptError, crc32c, ProgressiveMesh, RecordDecoder, unpackBase, type Grid, type RecordBlock } from "../src/index.js";

// dist/test/ stands under client/web/decoder/.
const directory = new URL("../../../../../tests/data/golden/", import.meta.url);

interface Golden {
  base: ProgressiveMesh;
  grid: Grid;
  blocks: { block: RecordBlock; after: string }[];
}

const bytesOf = (hex: string): Uint8Array => Uint8Array.from(Buffer.from(hex, "hex"));

function doubleOf(hex: string): number {
  return Buffer.from(hex, "hex").readDoubleLE(0);
}

function read(name: string): Golden {
  const lines = readFileSync(new URL(name, directory), "utf8").trim().split("\n").map((line) => line.split(" "));
  const [, vertices, faces, ghosts, encoding, bits, x, y, z, step] = lines.find((line) => line[0] === "base")!;
  const grid: Grid = { encoding: Number(encoding), bits: Number(bits), origin: [doubleOf(x!), doubleOf(y!), doubleOf(z!)], step: doubleOf(step!) };
  const counts = { vertices: Number(vertices), faces: Number(faces), ghosts: Number(ghosts) };
  const packed = lines.find((line) => line[0] === "packed");
  let base: { positions: Float64Array; corners: Uint32Array };
  if (packed) {
    base = unpackBase(bytesOf(packed[1]!), counts, grid);
  } else {
    const positions = bytesOf(lines.find((line) => line[0] === "positions")![1]!);
    const corners = bytesOf(lines.find((line) => line[0] === "corners")![1]!);
    base = { positions: new Float64Array(positions.buffer), corners: new Uint32Array(corners.buffer) };
  }
  const blocks: Golden["blocks"] = [];
  for (const line of lines) {
    if (line[0] === "block") {
      const [, first, count, kind, crc, hex] = line;
      const block = { first: Number(first), count: Number(count), encoding: Number(kind), crc32c: Number(crc), payload: bytesOf(hex!) };
      blocks.push({ block, after: "" });
    } else if (line[0] === "mesh") {
      blocks.at(-1)!.after = line.slice(1).join(" ");
    }
  }
  return { base: new ProgressiveMesh(base.positions, base.corners, counts.ghosts), grid, blocks };
}

const bytesIn = (array: Float64Array | Uint32Array): Uint8Array => new Uint8Array(array.buffer, array.byteOffset, array.byteLength);

function state(mesh: ProgressiveMesh): string {
  const positions = mesh.positions.slice(0, 3 * mesh.vertexCount);
  const corners = mesh.corners.slice(0, 3 * mesh.faceCount);
  return `${mesh.vertexCount} ${mesh.faceCount} ${crc32c(bytesIn(positions))} ${crc32c(bytesIn(corners))}`;
}

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
