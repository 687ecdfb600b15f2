// page.mjs VSPLITD DATA: how quick the page is on large parts, in software-drawn Chromium on loopback; prints lines of Markdown.
// Drawing by software is apart from what the page itself does: a worker's part of a step, and the copying into buffers.
import { join } from "node:path";
import { openPage, run, settled, slide, startServer, upload } from "../tests/e2e/page/browser.mjs";

const [vsplitd, data] = process.argv.slice(2);
const server = await startServer(vsplitd);
const { browser, page } = await openPage(server.address);
const median = (values) => values.sort((a, b) => a - b)[values.length >> 1];

/** Milliseconds from the last word of progress to the picture of the first faces, and of them all. */
async function firstPixels() {
  return page.evaluate(() => {
    const when = (name) => performance.getEntriesByName(name).at(-1)?.startTime ?? NaN;
    return { first: when("vsplit drawn first") - when("vsplit method ended"), all: when("vsplit drawn") - when("vsplit method ended") };
  });
}

await upload(page, join(data, "crankshaft.stl"));
await run(page, "improve", { subdivisionSize: 8, tolerance: 1, faces: 300000 });
await settled(page, 300000);
const pixels = await firstPixels();
console.log(`| improve to 300,000 faces: first faces on the screen after the method's last word | ${pixels.first.toFixed(0)} ms |`);
console.log(`| all 300,000 | ${pixels.all.toFixed(0)} ms |`);

await run(page, "improve", { subdivisionSize: 5, tolerance: 1, faces: 540000 });
await page.waitForFunction(() => location.hash.includes("representation=r2"), null, { timeout: 300000 });
await settled(page, 300000);
// Away from the resolution that was asked for: there a mesh is polished, with as many edits as faces.
await slide(page, (await page.$eval("#faces", (slider) => Number(slider.value))) / 1000 - 0.01);
await settled(page);
const faces = await page.evaluate(() => Number(document.getElementById("canvas").dataset.result));
const worker = [], copy = [], frame = [], records = [];
for (let n = 0; n < 11; ++n) {
  const value = await page.$eval("#faces", (slider) => Number(slider.value));
  const begun = await page.evaluate(() => performance.now());
  await slide(page, (value + (n % 2 === 0 ? -2 : 2)) / 1000);
  await settled(page);
  const told = /^(\d+) records, \d+ faces, ([\d.]+) ms/.exec(await page.getAttribute("#canvas", "data-step"));
  records.push(Number(told[1]));
  worker.push(Number(told[2]));
  const marks = await page.evaluate(() => performance.getEntriesByName("vsplit copied").at(-1)?.duration ?? NaN);
  copy.push(marks);
  frame.push(await page.evaluate((since) => performance.getEntriesByName("vsplit drawn").at(-1).startTime - since, begun));
}
console.log(`| a step of the slider at ${faces} faces, ${median(records)} records: in the worker | ${median(worker).toFixed(1)} ms |`);
console.log(`| its faces copied into the buffers | ${median(copy).toFixed(1)} ms |`);
console.log(`| from the step to the picture, drawn by software | ${median(frame).toFixed(0)} ms |`);
await browser.close();
await server.stop();
