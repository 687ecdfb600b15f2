// node dist/test/bench.js STREAM...: decodes and applies streams as `bench_records --stream` writes them, each five times
// and for a second at least, so that what runs is compiled; the fastest counts.
import { readFileSync } from "node:fs";
import { ProgressiveMesh, RecordDecoder } from "../src/index.js";
import { readGolden } from "./golden.js";

for (const path of process.argv.slice(2)) {
  const { base, grid, blocks } = readGolden(readFileSync(path, "utf8"));
  const announced = blocks.reduce((sum, { block }) => sum + block.count, 0);
  let best = Infinity;
  let splits = 0;
  let faces = 0;
  let spent = 0;
  for (let round = 0; round < 5 || spent < 1; ++round) {
    const mesh = new ProgressiveMesh(base.positions.slice(), base.corners.slice(), base.ghosts);
    const decoder = new RecordDecoder(grid);
    const begin = process.cpuUsage();
    mesh.foresee(announced); // as a stream's base mesh and a file's header do
    for (const { block } of blocks) decoder.decode(block, mesh);
    const { user, system } = process.cpuUsage(begin); // the kernel knows their sum, and guesses the parts
    const seconds = (user + system) / 1e6;
    spent += seconds;
    best = Math.min(best, seconds);
    splits = mesh.level;
    faces = mesh.faceCount;
  }
  console.log(`${path}: ${faces} faces, ${splits} splits, ${(splits / best / 1e6).toFixed(2)} M splits/s decoded and applied`);
}
