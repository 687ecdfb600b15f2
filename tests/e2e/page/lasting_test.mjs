// lasting_test.mjs VSPLITD VSPLIT DATA: what outlives a reload, a server and a session, and what is said of what does not.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { drop, openPage, run, runSteps, settled, shownOn, slide, startServer, takeSample, upload } from "./browser.mjs";

const [vsplitd, vsplit, data] = process.argv.slice(2).map((path) => resolve(path));
const place = mkdtempSync(join(tmpdir(), "vsplit-lasting-"));
const bracket = join(data, "bracket.stl");

const sessionOf = async (address, id) => (await fetch(`${address}/v1/sessions/${id}`)).json();
const problem = async (page) => {
  await page.waitForSelector("#problems p");
  const text = await page.textContent("#problems p");
  await page.click("#problems button");
  return text;
};
const drawn = (page) => page.waitForFunction(() => document.getElementById("canvas").dataset.source);
/** Some seconds of work. */
const long = { subdivisionSize: 3.5, tolerance: 0.2, faces: 15000 };

const steps = {
  async "what was typed is there after a reload, for each session its own"({ page }) {
    await upload(page, bracket);
    const first = await page.evaluate(() => location.hash);
    await page.fill("#improve-tolerance", "0.25");
    await page.fill("#weld", "0.001");
    await page.selectOption("#format", "OBJ");
    for (const verb of ["improve", "control"]) await page.click(`#${verb} summary`);
    await page.selectOption("#control-mode", "STRICT");
    await page.check("#improve-freezeBoundary");
    await page.reload();
    await drawn(page);
    const typed = async () => [await page.inputValue("#improve-tolerance"), await page.inputValue("#weld"), await page.inputValue("#format"), await page.inputValue("#control-mode"), await page.isChecked("#improve-freezeBoundary")];
    assert.deepEqual(await typed(), ["0.25", "0.001", "OBJ", "STRICT", true]);
    // A folded option that counts is seen.
    assert.ok(await page.isVisible("#control-mode"));
    await takeSample(page, "bracket.stl");
    await page.fill("#improve-tolerance", "0.5");
    await page.reload();
    await drawn(page);
    // Options of methods were for the part before.
    assert.deepEqual(await typed(), ["0.5", "0.001", "OBJ", "", false]);
    assert.notEqual(await page.evaluate(() => location.hash), first);
    await page.click('#improve button:text("Defaults")');
    await page.click('#control button:text("Defaults")');
    assert.deepEqual([await page.inputValue("#improve-tolerance"), await page.inputValue("#control-mode")], ["", ""]);
    await page.fill("#weld", "");
  },

  async "a method that runs at a reload is shown running again, and its result comes"({ page, address }) {
    await run(page, "improve", { subdivisionSize: 8, tolerance: 0.2, faces: 6000 });
    await settled(page);
    const before = await shownOn(page);
    await run(page, "improve", long);
    await page.waitForFunction(() => /Subdividing|Evaluating|Simplifying/.test(document.getElementById("work").textContent));
    await page.reload();
    // First what the address names, then what runs.
    await page.waitForFunction((faces) => Number(document.getElementById("canvas").dataset.result) === faces, before.result);
    await page.waitForFunction(() => /^Improve, asked for anew: /.test(document.getElementById("work").textContent));
    assert.equal(await page.getAttribute("#improve button[type=submit]", "aria-disabled"), "true");
    await page.waitForFunction(() => location.hash.includes("representation=r2"), null, { timeout: 120000 });
    await settled(page);
    const shown = await shownOn(page);
    assert.equal(shown.result, 15000);
    assert.equal((await sessionOf(address, shown.session)).representations.length, 2);
    // It is over: another reload asks for nothing.
    const asked = [];
    page.on("request", (request) => request.url().includes(":improve") && asked.push(request.url()));
    await page.reload();
    await settled(page);
    assert.deepEqual(asked, []);
  },

  async "where the method came to its end meanwhile, its result is the answer"({ page, address }) {
    // As if the last word had been lost on the way.
    const { session } = await shownOn(page);
    const before = (await sessionOf(address, session)).representations;
    await page.evaluate(([id, body]) => {
      const key = `vsplit session ${id}`;
      sessionStorage.setItem(key, JSON.stringify({ ...JSON.parse(sessionStorage.getItem(key)), method: { verb: "improve", body } }));
    }, [session, { options: { subdivisionSize: 8, tolerance: 0.2, faces: 6000 } }]);
    await page.reload();
    await page.waitForFunction(() => location.hash.includes("representation=r1"), null, { timeout: 30000 });
    await settled(page);
    assert.deepEqual((await sessionOf(address, session)).representations.map(({ id }) => id), before.map(({ id }) => id));
  },

  async "a method that was cancelled is not asked for again"({ page }) {
    await run(page, "improve", { ...long, faces: 14000 });
    await page.waitForFunction(() => /Simplifying|Evaluating/.test(document.getElementById("work").textContent));
    await page.click("#work .progress button");
    assert.match(await problem(page), /^CANCELLED/);
    await page.reload();
    await settled(page);
    await page.waitForTimeout(300);
    assert.equal(await page.locator("#work .progress").count(), 0);
  },

  async "an address that leads nowhere says so, also where it is the first"({ page, address }) {
    const before = await shownOn(page);
    for (const open of [(hash) => page.evaluate((text) => (location.hash = text), hash), (hash) => page.goto(`${address}/#${hash}`)]) {
      await open("session=0123456789abcdef0123456789abcdef");
      await page.waitForSelector("#problems p");
      assert.match(await page.textContent("#part"), /^Session 0123456789abcdef0123456789abcdef is not open$/);
      assert.deepEqual(await page.$eval("#canvas", ({ dataset }) => [dataset.source, dataset.result]), [undefined, undefined]);
      assert.match(await problem(page), /^NOT_FOUND no session/);
      await page.evaluate((id) => (location.hash = `session=${id}`), before.session);
      await settled(page);
    }
    // There, but without a mesh.
    const { id } = await (await fetch(`${address}/v1/sessions`, { method: "POST" })).json();
    await page.evaluate((text) => (location.hash = `session=${text}`), id);
    assert.match(await problem(page), /^EMPTY_INPUT session \w+ has no mesh/);
    assert.equal(await page.textContent("#part"), `Session ${id} is not open`);
    await fetch(`${address}/v1/sessions/${id}`, { method: "DELETE" });
    await page.evaluate((id) => (location.hash = `session=${id}&representation=r9`), before.session);
    assert.match(await problem(page), /^NOT_FOUND .*no representation r9/);
    await settled(page);
    // The address without a session is the page without a mesh.
    await page.evaluate(() => (location.hash = ""));
    await page.waitForFunction(() => document.getElementById("part").textContent === "No mesh yet");
    assert.equal(await page.$eval("#canvas", ({ dataset }) => dataset.source), undefined);
    await page.goBack();
    await settled(page);
  },

  async "of several files that are dropped it is said which was taken, and the others are at hand"({ page }) {
    const others = ["second.stl", "third.obj"].map((name) => join(place, name));
    writeFileSync(others[0], readFileSync(join(data, "combined.stl")));
    writeFileSync(others[1], "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
    const folder = join(place, "a folder");
    mkdirSync(folder);
    await drop(page, bracket, ...others, folder);
    await page.waitForFunction(() => document.getElementById("summary").textContent.startsWith("9,084 faces"));
    assert.match(await page.textContent("#dropped"), /^bracket\.stl was taken\. Dropped with it: second\.stl third\.obj .*it is a folder: a folder\.$/);
    await page.click('#dropped button:text("third.obj")');
    await page.waitForFunction(() => document.getElementById("summary").textContent.startsWith("4 faces"));
    assert.match(await page.textContent("#dropped"), /^third\.obj was taken\. Dropped with it: bracket\.stl second\.stl/);
    await drop(page, folder);
    assert.match(await problem(page), /^UNSUPPORTED a folder: a folder cannot be opened; drop a mesh file \(STL, .*\)/);
    assert.equal(await page.textContent("#dropped"), "");
    assert.equal(await page.textContent("#part"), "third.obj");
  },

  async "what is no mesh is refused by its name, and the mesh that is open stays"({ page, address }) {
    const sessions = async () => (await (await fetch(`${address}/v1/sessions`)).json()).sessions.length;
    const before = [await sessions(), (await shownOn(page)).session];
    const refused = async (name, bytes, words) => {
      writeFileSync(join(place, name), bytes);
      await drop(page, join(place, name));
      assert.match(await problem(page), words);
    };
    await refused("nothing.stl", "", /^EMPTY_INPUT nothing\.stl: the file is empty, 0 bytes$/);
    await refused("part.step", "ISO-10303-21;\nHEADER;\n", /^UNKNOWN_FORMAT part\.step: by its name it is no mesh file \(accepted: STL, .*VSPLIT\); byte 0/);
    await refused("photo.jpg", readFileSync(join(data, "../../docs/images/page.jpg")).subarray(0, 3000), /^[A-Z_]+ photo\.jpg: by its name it is no mesh file \(accepted: STL, /);
    await refused("bad.stl", "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0\n", /^[A-Z_]+ bad\.stl: (line|byte) /);
    for (const [name, words] of Object.entries({
      "mrr_of_version_4.vsplit": /^UNSUPPORTED mrr_of_version_4\.vsplit: byte 8: the file is of version 4 of the format/,
      "mrr_cut_in_block.vsplit": /^TRUNCATED_INPUT mrr_cut_in_block\.vsplit: byte 330/,
      "mrr_changed_split.vsplit": /^CORRUPT mrr_changed_split\.vsplit: .*record 0/,
    })) {
      await drop(page, join(data, "broken", name));
      assert.match(await problem(page), words);
    }
    assert.deepEqual([await sessions(), (await shownOn(page)).session], before);
    assert.equal(await page.textContent("#part"), "third.obj");
  },

  async "a .vsplit file opens without the server, at all its resolutions"({ page, address, context }) {
    const file = join(place, "improved.vsplit");
    // On raw slivers control leaves bounds that are broken: they are to be flown to.
    const made = (...words) => {
      try {
        execFileSync(vsplit, words, { stdio: "pipe" });
      } catch (error) {
        assert.equal(error.status, 2, String(error.stderr));
      }
    };
    made("control", bracket, "--subdivisions", "1", "--tolerance", "0.2", "--min-stretch", "0.5", "--unit", "mm", "-o", file);
    const before = (await shownOn(page)).session;
    const asked = [];
    const note = (request) => request.url().includes("/v1/") && asked.push(`${request.method()} ${request.url()}`);
    page.on("request", note);
    await drop(page, file);
    await page.waitForFunction(() => document.getElementById("part").textContent === "improved.vsplit");
    await page.waitForFunction(() => !document.getElementById("faces").disabled && document.getElementById("canvas").dataset.result);
    // The mesh before was uploaded here, and gives way.
    assert.equal((await fetch(`${address}/v1/sessions/${before}`)).status, 404);
    assert.equal(await page.evaluate(() => location.hash), "");
    assert.match(await page.textContent("#summary"), /^A \.vsplit file, opened here alone: .* faces; lengths in mm/);
    assert.equal(await page.inputValue("#view"), "result");
    const told = (faces) => {
      const at = join(place, "at.off");
      made("resolution", file, "--faces", String(faces), "-o", at);
      return JSON.parse(execFileSync(vsplit, ["quality", at, "--json"], { encoding: "utf8" }));
    };
    const english = new Intl.NumberFormat("en");
    for (const share of [1, 0.3, 0, 0.7]) {
      await slide(page, share);
      await page.waitForFunction(() => document.getElementById("stage").getAttribute("aria-busy") === "false");
      const { result } = await shownOn(page);
      const { quality } = told(result);
      await page.waitForFunction((faces) => document.querySelector("#table tbody td:last-child").textContent === faces, english.format(result));
      const cells = await page.$$eval("#table tbody td:last-child", (all) => all.slice(0, 5).map((cell) => cell.textContent));
      assert.deepEqual(cells, [english.format(quality.faces), quality.stretchMean.toFixed(3), (quality.stretchMin ?? 0).toFixed(3), english.format(quality.facesBelow02 ?? 0), String(quality.valenceMax)]);
      assert.deepEqual(
        await page.$$eval("#worst button", (all) => all.map((one) => one.textContent.slice(0, one.textContent.indexOf(", size")))),
        quality.worstFaces.map(({ face = 0, stretch = 0 }) => `face ${english.format(face)}: stretch ${stretch.toFixed(3)}`),
      );
    }
    await page.click('#notes .note:has(strong:text-is("min_stretch not met")) button');
    await page.waitForSelector("#canvas[data-flown]");
    assert.deepEqual(asked.filter((line) => !line.startsWith("DELETE")), []);
    page.off("request", note);
    assert.equal(await page.getAttribute("#improve button[type=submit]", "aria-disabled"), "true");
    assert.equal(await page.getAttribute("#download", "aria-disabled"), "true");
    assert.equal(await page.locator("#problems p").count(), 0);
    // An open mesh, and one that says nothing of itself.
    for (const name of ["file_1_open.vsplit", "file_1_closed.vsplit"]) {
      await drop(page, join(data, "golden", name));
      await page.waitForFunction((title) => document.getElementById("part").textContent === title, name);
      await page.waitForFunction(() => document.querySelectorAll("#worst button").length > 0);
    }
    await upload(page, bracket);
    assert.equal(await page.inputValue("#view"), "both");
    assert.ok(context);
  },

  async "a session that is deleted meanwhile is said to be gone, and stays to be looked at"({ page, address }) {
    await run(page, "improve", { subdivisionSize: 8, tolerance: 0.2, faces: 6000 });
    await settled(page);
    await slide(page, 0.5);
    await settled(page);
    const { session, result } = await shownOn(page);
    await fetch(`${address}/v1/sessions/${session}`, { method: "DELETE" });
    await page.click("#control button[type=submit]");
    assert.match(await problem(page), /^NOT_FOUND no session/);
    await page.waitForFunction(() => document.getElementById("stage").getAttribute("aria-busy") === "false");
    assert.match(await page.textContent("#summary"), /has this session no more/);
    assert.equal((await shownOn(page)).result, result);
    assert.equal(await page.getAttribute("#control button[type=submit]", "aria-disabled"), "true");
    assert.equal(await page.getAttribute("#download", "aria-disabled"), "true");
    await slide(page, 0.1);
    await page.waitForFunction((faces) => Number(document.getElementById("canvas").dataset.result) < faces, result);
    await upload(page, bracket);
    assert.equal(await page.getAttribute("#control button[type=submit]", "aria-disabled"), "false");
  },

  async "one session in two tabs: what one makes does not disturb the other"({ page, context, address }) {
    await page.click('#improve button:text("Defaults")');
    const other = await context.newPage();
    await other.goto(page.url());
    await drawn(other);
    await Promise.all([run(page, "improve", { subdivisionSize: 8, tolerance: 0.2, faces: 6000 }), run(other, "improve", { subdivisionSize: 8, tolerance: 0.2, faces: 5000 })]);
    await Promise.all([settled(page), settled(other)]);
    assert.deepEqual([(await shownOn(page)).result, (await shownOn(other)).result], [6000, 5000]);
    await Promise.all([slide(page, 0.9), slide(other, 0.1)]);
    await Promise.all([settled(page), settled(other)]);
    // One takes another mesh: the session, which it had uploaded, is deleted under the other.
    await takeSample(page, "scan.ply");
    await slide(other, 1);
    assert.match(await problem(other), /^NOT_FOUND no session/);
    assert.match(await other.textContent("#summary"), /no more/);
    await other.close();
    assert.ok(address);
  },

  async "the graphics card may be taken away, and comes back with the picture"({ page }) {
    await page.waitForTimeout(500);
    const before = await page.locator("#canvas").screenshot();
    await page.evaluate(() => {
      window.card = document.querySelector("#canvas canvas").getContext("webgl2").getExtension("WEBGL_lose_context");
      window.card.loseContext();
    });
    await page.waitForFunction(() => document.querySelector(".undrawn").textContent.includes("taken away"));
    await page.evaluate(() => window.card.restoreContext());
    await page.waitForFunction(() => document.querySelector(".undrawn").textContent === "");
    await page.waitForTimeout(500);
    assert.deepEqual(await page.locator("#canvas").screenshot(), before);
  },

  async "a server that ends and comes back: what ran is asked for anew, in another tab on demand"({ page, context }) {
    const sessions = join(place, "sessions");
    let server = await startServer(vsplitd, "--data-dir", sessions);
    const http = ["--http", new URL(server.address).host];
    await page.goto(server.address);
    await page.waitForSelector("#improve button[type=submit]");
    await upload(page, bracket);
    await page.click('#improve button:text("Defaults")');
    await run(page, "improve", long);
    await page.waitForFunction(() => /Simplifying|Evaluating/.test(document.getElementById("work").textContent));
    await server.kill();
    assert.match(await problem(page), /^UNAVAILABLE/);
    await page.waitForSelector("#work .progress", { state: "detached" });
    await page.click("#improve button[type=submit]");
    assert.match(await problem(page), /^UNAVAILABLE the server cannot be reached/);
    server = await startServer(vsplitd, "--data-dir", sessions, ...http);
    try {
      const other = await context.newPage();
      await other.goto(page.url());
      await other.waitForSelector('#notes button:text("Run Improve again")');
      assert.match(await other.textContent("#notes"), /Improve was cut off/);
      await page.reload();
      await page.waitForFunction(() => /^Improve, asked for anew: /.test(document.getElementById("work").textContent));
      await other.click('#notes button:text("Run Improve again")');
      await Promise.all([settled(page, 120000), settled(other, 120000)]);
      assert.deepEqual([(await shownOn(page)).result, (await shownOn(other)).result], [15000, 15000]);
      const { representations } = await sessionOf(server.address, (await shownOn(page)).session);
      assert.equal(representations.length, 1);
      assert.doesNotMatch(await other.textContent("#notes"), /cut off/);
      await other.close();
    } finally {
      await server.stop();
    }
  },

  async "a token that is taken back is asked for anew, and another's session stays shut"({ page }) {
    const file = join(place, "tokens");
    const made = (who) => {
      const lines = execFileSync(vsplitd, ["--new-token", `${who}:read-write`], { encoding: "utf8" }).trim().split("\n");
      const line = lines.find((text) => text.startsWith(`${who} `));
      return { line, token: lines.map((text) => text.split(/\s+/).at(-1)).find((word) => !line.includes(word)) };
    };
    const write = (...tokens) => writeFileSync(file, `${tokens.map(({ line }) => line).join("\n")}\n`, { mode: 0o600 });
    const [first, second, bob] = [made("ann"), made("ann"), made("bob")];
    write(first, bob);
    const server = await startServer(vsplitd, "--token-file", file);
    const give = async ({ token }) => {
      await page.waitForSelector("#access:not([hidden])");
      await page.fill("#token", token);
      await page.press("#token", "Enter");
      assert.equal(await page.inputValue("#token"), "");
    };
    try {
      await page.goto(server.address);
      await page.waitForSelector("#improve button[type=submit]");
      await page.setInputFiles("#file", bracket);
      await give(first);
      await upload(page, bracket);
      await run(page, "improve", { subdivisionSize: 8, tolerance: 0.2, faces: 6000 });
      await settled(page);
      const before = await shownOn(page);
      write(second, bob);
      // The file is read again within some seconds.
      for (let wait = 0; wait < 100; ++wait) {
        if ((await fetch(`${server.address}/v1/sessions`, { headers: { Authorization: `Bearer ${first.token}` } })).status === 401) break;
        await page.waitForTimeout(200);
      }
      await page.click("#control button[type=submit]");
      await page.waitForSelector("#problems p");
      assert.match(await page.textContent("#problems p"), /^UNAUTHENTICATED/);
      // Ann's session is not Bob's.
      await give(bob);
      assert.match(await problem(page), /^NOT_FOUND no session/);
      assert.equal(await page.$eval("#canvas", ({ dataset }) => dataset.source), undefined);
      await page.evaluate(() => sessionStorage.setItem("vsplit-token", "none such"));
      await page.reload();
      await give(second);
      await settled(page);
      await drawn(page);
      assert.deepEqual(await shownOn(page), before);
    } finally {
      await server.stop();
    }
  },

  async "what a server refuses for now is told with the time to wait"({ page }) {
    const server = await startServer(vsplitd, "--max-sessions", "1");
    try {
      const { id } = await (await fetch(`${server.address}/v1/sessions`, { method: "POST" })).json();
      await page.goto(server.address);
      await page.waitForSelector("#improve button[type=submit]");
      await page.setInputFiles("#file", bracket);
      const words = await problem(page);
      assert.match(words, /^LIMIT_EXCEEDED bracket\.stl: .*1/);
      assert.match(words, /Try again in \d+ s\./);
      await fetch(`${server.address}/v1/sessions/${id}`, { method: "DELETE" });
      await upload(page, bracket);
    } finally {
      await server.stop();
    }
  },

  async "nothing went wrong on the way"({ said }) {
    const expected = /^Failed to load resource|GL Driver Message|WebGL: CONTEXT_LOST_WEBGL|THREE\.WebGLRenderer: Context (Lost|Restored)/;
    assert.deepEqual(said.filter((text) => !expected.test(text)), []);
  },
};

const server = await startServer(vsplitd);
const opened = await openPage(server.address);
await runSteps(steps, { ...opened, address: server.address });
await opened.browser.close();
await server.stop();
rmSync(place, { recursive: true });
