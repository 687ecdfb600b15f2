import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import { test } from "node:test";
import { CorruptError, float64Grid, isMrrFile, MrrFile, MrrFileError, ProgressiveMesh, RecordDecoder } from "../src/index.js";

// dist/test/ stands under client/web/decoder/.
const data = new URL("../../../../../tests/data/", import.meta.url);
const bytesOf = (name: string): Uint8Array => new Uint8Array(readFileSync(new URL(name, data)));

function load(bytes: Uint8Array): { file: MrrFile; mesh: ProgressiveMesh } {
  const file = new MrrFile(bytes);
  const mesh = new ProgressiveMesh(file.base.positions, file.base.corners, file.base.ghosts);
  const decoder = new RecordDecoder(float64Grid);
  for (const block of file.blocks()) decoder.decode(block, mesh);
  file.checkLevel(mesh.level);
  return { file, mesh };
}

/** The mesh that the golden stream of exact positions ends with: the files were written from the same representations. */
function finest(name: string): string {
  const last = readFileSync(new URL(`golden/records_1_float64_${name}.golden`, data), "utf8").trim().split("\n").at(-1)!;
  return last.split(" ").slice(1, 3).join(" ");
}

for (const name of ["closed", "open"]) {
  test(`file_1_${name}.vsplit is read whole`, () => {
    const bytes = bytesOf(`golden/file_1_${name}.vsplit`);
    assert.ok(isMrrFile(bytes));
    const { file, mesh } = load(bytes);
    assert.equal(mesh.records, file.records);
    assert.equal(`${mesh.vertexCount} ${mesh.faceCount}`, finest(name));
    assert.ok(file.shown > 0);
    assert.ok(name === "closed" ? file.base.ghosts === 0 : file.base.ghosts > 0);
  });

  test(`file_1_${name}.vsplit: no byte can be changed, and none left out at the end or added`, () => {
    const bytes = bytesOf(`golden/file_1_${name}.vsplit`);
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
  "mrr_of_version_2.vsplit": ["UNSUPPORTED", "byte 8"],
  "mrr_cut_in_header.vsplit": ["TRUNCATED_INPUT", "byte 30"],
  "mrr_cut_in_block.vsplit": ["TRUNCATED_INPUT", "byte 330: the file ends after 0 of 4 records"],
  "mrr_changed_header.vsplit": ["CORRUPT", "byte 44"],
  "mrr_changed_position.vsplit": ["CORRUPT", "byte 48"],
  "mrr_changed_split.vsplit": ["CORRUPT", "record block from record 0 on"],
  "mrr_open_base.vsplit": ["CORRUPT", "base mesh: it is not closed"],
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
