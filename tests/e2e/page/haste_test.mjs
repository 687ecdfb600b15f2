// haste_test.mjs VSPLITD DATA: whoever does the next thing before the last one is done gets what was asked for last, and no complaint.
import assert from "node:assert/strict";
import { join } from "node:path";
import { openPage, run, runSteps, settled, shownOn, slide, startServer, upload } from "./browser.mjs";
import { startProxy } from "./stalling_proxy.mjs";

const [vsplitd, data] = process.argv.slice(2);

const asked = (page) => page.evaluate(() => document.getElementById("faces-shown").textContent);
const complaints = (page) => page.locator("#problems p").allTextContents();

/** All in one go: no step has an answer before the next one is there. */
const drag = (page, shares) =>
  page.evaluate((values) => {
    const slider = document.getElementById("faces");
    for (const value of values) {
      slider.value = String(1000 * value);
      slider.dispatchEvent(new Event("input"));
    }
  }, shares);

/** Holds back the answers of a path until they are let go. */
async function holdBack(page, pattern) {
  const waiting = [];
  let open = false;
  await page.route(pattern, (route) => (open ? route.continue() : waiting.push(route)));
  return {
    count: () => waiting.length,
    async letGo() {
      open = true;
      // Those that the page gave up have nothing to go on with.
      for (const route of waiting) await route.continue().catch(() => undefined);
      await page.unroute(pattern);
    },
  };
}

const steps = {
  async "a slider dragged on while records come ends where it was let go"({ page, address }) {
    await upload(page, join(data, "bracket.stl"));
    await run(page, "improve", { subdivisionSize: 4, tolerance: 0.2, faces: 4000 });
    await settled(page);
    await drag(page, [0.8, 0.85, 0.9, 0.95, 1]);
    await settled(page);
    assert.deepEqual(await complaints(page), []);
    const { session, representation, result } = await shownOn(page);
    const { representations } = await (await fetch(`${address}/v1/sessions/${session}`)).json();
    assert.equal(result, representations.find((one) => one.id === representation).facesMax);
  },

  async "steps of the slider that are overtaken while they wait are not drawn"({ page, address }) {
    await page.evaluate(() => {
      window.drawn = 0;
      new PerformanceObserver((list) => (window.drawn += list.getEntriesByName("vsplit copied").length)).observe({ entryTypes: ["measure"] });
    });
    const shares = Array.from({ length: 60 }, (_, n) => 1 - n / 100);
    await drag(page, shares);
    await settled(page);
    const steps = await page.evaluate(() => window.drawn);
    assert.ok(steps > 0 && steps <= 10, `${steps} of ${shares.length} steps were drawn`);
    const { session, representation, result } = await shownOn(page);
    const { representations } = await (await fetch(`${address}/v1/sessions/${session}`)).json();
    const { facesMin, facesMax } = representations.find((one) => one.id === representation);
    const last = facesMin * (facesMax / facesMin) ** shares.at(-1);
    assert.ok(Math.abs(result - last) <= 2, `${result} faces are shown where ${last} were asked for last`);
    assert.deepEqual(await complaints(page), []);
  },

  async "down again while finer records are on their way stays down"({ page }) {
    await slide(page, 0.3);
    await settled(page);
    const low = (await shownOn(page)).result;
    await page.reload();
    await settled(page);
    const held = await holdBack(page, "**/*:setResolution");
    await drag(page, [0.9]);
    await page.waitForTimeout(500);
    await drag(page, [0.3]);
    await held.letGo();
    await settled(page);
    await page.waitForTimeout(500);
    const { result } = await shownOn(page);
    assert.ok(Math.abs(result - low) <= 2, `${result} faces are shown where ${low} were asked for; the slider says ${await asked(page)}`);
    assert.deepEqual(await complaints(page), []);
  },

  async "methods begun, cancelled and begun again in one go end with the last one"({ page, address }) {
    await page.fill("#improve-subdivisionSize", "4");
    for (let n = 0; n < 8; ++n) {
      await page.fill("#improve-faces", String(5000 + n));
      await page.evaluate((verb) => {
        const button = document.querySelector(`#${verb} button[type=submit]`);
        for (let click = 0; click < 3; ++click) button.click();
        document.querySelector("#work .progress button")?.click();
      }, n % 2 ? "improve" : "control");
      await page.waitForTimeout(40 * n);
    }
    await page.waitForSelector("#work .progress", { state: "detached" });
    await page.waitForFunction(() => document.getElementById("stage").getAttribute("aria-busy") === "false");
    for (const text of await complaints(page)) assert.match(text, /^CANCELLED/);
    await run(page, "improve", { faces: 5100 });
    await page.waitForFunction(() => Number(document.getElementById("canvas").dataset.result) === 5100, null, { timeout: 60000 });
    await settled(page);
    const { session, representation, result } = await shownOn(page);
    const { representations } = await (await fetch(`${address}/v1/sessions/${session}`)).json();
    assert.equal(representations.find((one) => one.id === representation).faces, result);
    assert.deepEqual(await complaints(page), []);
  },

  async "what is not shown any more is not held any more"({ page, context }) {
    const browser = await context.newCDPSession(page);
    const held = async () => {
      await browser.send("HeapProfiler.collectGarbage");
      await browser.send("HeapProfiler.collectGarbage");
      const { usedSize, backingStorageSize } = await browser.send("Runtime.getHeapUsage");
      return { bytes: usedSize + backingStorageSize, nodes: (await browser.send("Memory.getDOMCounters")).nodes };
    };
    let before;
    for (let n = 0; n < 20; ++n) {
      await run(page, "improve", { subdivisionSize: 10, faces: 5000 + 10 * n });
      await page.waitForFunction((faces) => Number(document.getElementById("canvas").dataset.result) === faces, 5000 + 10 * n, { timeout: 60000 });
      await settled(page);
      await slide(page, 0.5);
      await settled(page);
      if (n === 4) before = await held();
    }
    const after = await held();
    assert.ok(after.bytes < before.bytes + 2e6, `${before.bytes} bytes after 5 results, ${after.bytes} after 20`);
    assert.ok(after.nodes < before.nodes + 1000, `${before.nodes} nodes after 5 results, ${after.nodes} after 20`);
    // Meshes are in two workers, of which each holds one.
    assert.equal(page.workers().length, 2);
    for (let n = 0; n < 3; ++n) await upload(page, join(data, "bracket.stl"));
    assert.equal(page.workers().length, 2);
    await run(page, "improve", { subdivisionSize: 4, tolerance: 0.2, faces: 4000 });
    await settled(page);
    assert.deepEqual(await complaints(page), []);
  },

  async "a method cancelled while its mesh arrives leaves the one before, with its slider"({ page, address, proxy }) {
    const before = await shownOn(page);
    proxy.stall = true;
    await run(page, "improve", { subdivisionSize: 4, tolerance: 0.2, faces: 30000 });
    await page.waitForFunction((faces) => Number(document.getElementById("canvas").dataset.result) !== faces, before.result, { timeout: 60000 });
    await page.click("#work .progress button");
    proxy.stall = false;
    await page.waitForSelector("#problems p");
    assert.match((await complaints(page)).join(), /^CANCELLED/);
    await page.click("#problems button");
    await settled(page);
    assert.deepEqual(await shownOn(page), before);
    await slide(page, 0.6);
    await settled(page);
    const { session, representation, result } = await shownOn(page);
    const quality = await (await fetch(`${address}/v1/sessions/${session}/quality?representation=${representation}&faces=${result}`)).json();
    assert.equal(result, quality.faces);
    assert.notEqual(result, before.result);
    assert.deepEqual(await complaints(page), []);
  },
};

const server = await startServer(vsplitd);
const proxy = await startProxy(server.address);
const opened = await openPage(proxy.address);
await runSteps(steps, { ...opened, address: server.address, proxy });
await opened.browser.close();
proxy.stop();
await server.stop();
