import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import { test } from "node:test";
import { CorruptError, isMrrFile, MrrFile, MrrFileError, ProgressiveMesh, RecordDecoder } from "../src/index.js";

// dist/test/ stands under client/web/decoder/.
const data = new URL("../../../../../tests/data/", import.meta.url);
const bytesOf = (name: string): Uint8Array => new Uint8Array(readFileSync(new URL(name, data)));

function load(bytes: Uint8Array): { file: MrrFile; mesh: ProgressiveMesh } {
  const file = new MrrFile(bytes);
  const mesh = new ProgressiveMesh(file.base.positions, file.base.corners, file.base.ghosts);
  const decoder = new RecordDecoder(file.grid);
  for (const block of file.blocks()) decoder.decode(block, mesh);
  file.checkLevel(mesh.level);
  return { file, mesh };
}

/** The mesh that the golden stream of exact positions ends with: the files were written from the same representations. */
function finest(name: string): string {
  const version = name === "improved" ? 2 : 1;
  const last = readFileSync(new URL(`golden/records_${version}_float64_${name}.golden`, data), "utf8").trim().split("\n").at(-1)!;
  return last.split(" ").slice(1, 3).join(" ");
}

/** The blocks, and the mesh after them, are what the index says. */
function checkIndex(file: MrrFile): void {
  const mesh = new ProgressiveMesh(file.base.positions, file.base.corners, file.base.ghosts);
  const decoder = new RecordDecoder(file.grid);
  let n = 0;
  for (const block of file.blocks()) {
    decoder.decode(block, mesh);
    const entry = file.index[n++]!;
    assert.deepEqual([entry.first, entry.count, entry.splits, entry.crc32c], [block.first, block.count, mesh.level, block.crc32c]);
    if (file.base.ghosts === 0) assert.equal(entry.faces, mesh.faceCount);
  }
  assert.equal(n, file.index.length);
}

const golden = readdirSync(new URL("golden/", data)).filter((name) => /^file_\d_(.*_)?(closed|open|improved)\.vsplit$/.test(name));

test("golden files of every version and encoding are there", () => assert.equal(golden.length, 17));

for (const name of golden) {
  test(`${name} is read whole`, () => {
    const bytes = bytesOf(`golden/${name}`);
    const of = /(closed|open|improved)\.vsplit$/.exec(name)![1]!;
    assert.ok(isMrrFile(bytes));
    const { file, mesh } = load(bytes);
    assert.equal(mesh.records, file.records);
    assert.equal(`${mesh.vertexCount} ${mesh.faceCount}`, finest(of));
    assert.ok(file.shown > 0);
    assert.equal(file.base.ghosts > 0, of === "open");
    if (name.startsWith("file_1_")) return;
    assert.equal(file.unit, "mm");
    assert.match(file.source!, /^010911.*f9$/);
    assert.ok(file.baseDeviation >= 0.5 && file.baseDeviation < 0.51);
    assert.equal(file.maxError > 0, !name.includes("float64"));
    assert.equal(file.index.length, 3);
    assert.ok(file.index[0]!.deviation >= 0.25 && Number.isNaN(file.index[1]!.deviation));
    checkIndex(file);
  });

  test(`${name}: no byte can be changed, and none left out at the end or added`, () => {
    const bytes = bytesOf(`golden/${name}`);
    const refused = (changed: Uint8Array, what: string): void =>
      assert.throws(() => load(changed), (error: Error) => error instanceof MrrFileError || error instanceof CorruptError, what);
    for (let at = 0; at < bytes.length; at += at < 100 ? 1 : 97) {
      const changed = bytes.slice();
      changed[at]! ^= 4;
      refused(changed, `byte ${at} changed`);
      refused(bytes.slice(0, at), `cut to ${at} bytes`);
    }
    const longer = new Uint8Array(bytes.length + 1);
    longer.set(bytes);
    refused(longer, "a byte more");
  });
}

/** As tests/core/mrr_file_test.cpp has them. */
const broken: Record<string, [fault: string, place: string]> = {
  "mrr_of_version_4.vsplit": ["UNSUPPORTED", "byte 8"],
  "mrr_cut_in_header.vsplit": ["TRUNCATED_INPUT", "byte 30"],
  "mrr_cut_in_block.vsplit": ["TRUNCATED_INPUT", "byte 330: the file ends after 0 of 4 records"],
  "mrr_changed_header.vsplit": ["CORRUPT", "byte 44"],
  "mrr_changed_position.vsplit": ["CORRUPT", "byte 48"],
  "mrr_changed_split.vsplit": ["CORRUPT", "record block from record 0 on"],
  "mrr_open_base.vsplit": ["CORRUPT", "the base mesh: "],
  "mrr_ghosts_side_by_side.vsplit": ["CORRUPT", "byte 48: the base mesh: face 0 joins two ghosts"],
  "mrr_flips_twice.vsplit": ["CORRUPT", "record block from record 0 on"],
  "mrr_ends_with_a_move.vsplit": ["CORRUPT", "the last of 3 records is no split"],
  "mrr_sent_as_text.vsplit": ["UNKNOWN_FORMAT", "byte 0"],
};

for (const [name, [fault, place]] of Object.entries(broken)) {
  test(`${name} is refused as ${fault}`, () => {
    assert.throws(
      () => load(bytesOf(`broken/${name}`)),
      (error: Error) => {
        assert.equal(error instanceof MrrFileError ? error.fault : error instanceof CorruptError ? "CORRUPT" : "", fault, error.message);
        assert.ok(error.message.includes(place), error.message);
        return true;
      },
    );
  });
}

test("every broken file is in the table", () => {
  const present = readdirSync(new URL("broken/", data)).filter((name) => name.endsWith(".vsplit"));
  assert.deepEqual(present.sort(), Object.keys(broken).sort());
});
