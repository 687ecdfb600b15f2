// page_test.mjs VSPLITD VSPLIT DATA: the page as people use it, against what the server says of the same meshes.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { openPage, run, runSteps, settled, shownOn, slide, startServer, takeSample, upload } from "./browser.mjs";

const [vsplitd, vsplit, data] = process.argv.slice(2);
const place = mkdtempSync(join(tmpdir(), "vsplit-page-"));

/** A square with a hole: two boundaries. */
function openMesh() {
  const cells = 24, lines = [];
  const at = (i, j) => i * (cells + 1) + j;
  const faces = [];
  for (let i = 0; i <= cells; ++i) for (let j = 0; j <= cells; ++j) lines.push(`${i} ${j} ${Math.sin(i / 5)}`);
  for (let i = 0; i < cells; ++i) {
    for (let j = 0; j < cells; ++j) {
      if (i > 8 && i < 14 && j > 8 && j < 14) continue;
      faces.push(`3 ${at(i, j)} ${at(i + 1, j)} ${at(i + 1, j + 1)}`, `3 ${at(i, j)} ${at(i + 1, j + 1)} ${at(i, j + 1)}`);
    }
  }
  const used = lines.map((_, n) => faces.some((face) => face.split(" ").slice(1).includes(String(n))));
  const number = [];
  used.forEach((is) => number.push(is ? number.filter((n) => n >= 0).length : -1));
  const kept = lines.filter((_, n) => used[n]);
  const renamed = faces.map((face) => `3 ${face.split(" ").slice(1).map((n) => number[n]).join(" ")}`);
  const path = join(place, "open.off");
  writeFileSync(path, `OFF\n${kept.length} ${renamed.length} 0\n${kept.join("\n")}\n${renamed.join("\n")}\n`);
  return path;
}

async function qualityOf(address, { session, representation, result }) {
  const answer = await fetch(`${address}/v1/sessions/${session}/quality?representation=${representation}&faces=${result}`);
  return answer.json();
}

/** The faces that are drawn and the figures beside them are those of the server's mesh. */
async function agrees(page, address) {
  const shown = await shownOn(page);
  const quality = await qualityOf(address, shown);
  assert.equal(shown.result, quality.faces);
  const english = new Intl.NumberFormat("en");
  const expected = [english.format(quality.faces), quality.stretchMean.toFixed(3), (quality.stretchMin ?? 0).toFixed(3), english.format(quality.facesBelow02 ?? 0), String(quality.valenceMax)];
  // Figures follow the mesh by a moment.
  const cells = () => page.$$eval("#table tbody td:last-child", (all) => all.slice(0, 5).map((cell) => cell.textContent));
  for (let wait = 0; wait < 50 && JSON.stringify(await cells()) !== JSON.stringify(expected); ++wait) await page.waitForTimeout(100);
  assert.deepEqual(await cells(), expected);
  return shown;
}

const steps = {
  async "the page asks no other server and allows no other script"({ address, asked }) {
    const answer = await fetch(address);
    const said = Object.fromEntries(answer.headers.get("content-security-policy").split("; ").map((rule) => [rule.split(" ")[0], rule.split(" ").slice(1).join(" ")]));
    const own = "'self'", none = "'none'";
    assert.deepEqual(said, {
      "default-src": none, "script-src": `${own} 'wasm-unsafe-eval'`, "worker-src": own, "style-src": own, "img-src": own, "connect-src": own, "base-uri": none, "form-action": none, "frame-ancestors": none,
    });
    // Nothing inline that this forbids, and nothing from elsewhere.
    const html = await answer.text();
    assert.doesNotMatch(html, /<script(?![^>]*\ssrc=)|<style|\sstyle=|\son\w+=|https?:/i);
    for (const url of asked) assert.ok(url.startsWith(address), url);
  },

  async "every control has a name"({ page }) {
    const nameless = await page.evaluate(() =>
      [...document.querySelectorAll("input, select, button, a.button")]
        .filter((one) => !(one.labels?.length || one.getAttribute("aria-label") || one.textContent.trim()))
        .map((one) => one.outerHTML));
    assert.deepEqual(nameless, []);
    assert.ok((await page.locator("#improve .field").count()) > 10);
  },

  async "what is no mesh is a problem with the server's cause and words"({ page }) {
    await page.setInputFiles("#file", { name: "bad.stl", mimeType: "", buffer: Buffer.from("solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0\n") });
    await page.waitForSelector("#problems p");
    assert.match(await page.textContent("#problems"), /^(MALFORMED_INPUT|TRUNCATED_INPUT|UNKNOWN_FORMAT) .*(line|byte)/);
    assert.ok(await page.isDisabled("#improve button[type=submit]"));
    await page.click("#problems button");
  },

  async "an upload is drawn, with its figures"({ page }) {
    await upload(page, join(data, "bracket.stl"));
    assert.equal((await shownOn(page)).source, 9084);
    assert.match(await page.textContent("#summary"), /9,084 faces, 4,518 vertices; 1 piece, closed, genus 13/);
    await page.waitForSelector("#worst li button");
  },

  async "an option out of range is pointed at"({ page }) {
    await run(page, "improve", { minStretch: 2 });
    await page.waitForSelector("#improve-minStretch[aria-invalid]");
    assert.match(await page.textContent("#problems"), /^INVALID_OPTION .*accepted is 0 to 1/);
    await page.fill("#improve-minStretch", "");
  },

  async "what is no number, or no whole one, is refused at its field, also a folded one"({ page }) {
    let sent = 0;
    const count = (request) => (sent += request.method() === "POST" ? 1 : 0);
    page.on("request", count);
    const refused = async (id, typed, words, press) => {
      const field = page.locator(id);
      await field.evaluate((one) => {
        one.value = "";
        one.closest("details")?.setAttribute("open", "");
      });
      await field.pressSequentially(typed);
      await field.evaluate((one) => one.closest("details")?.removeAttribute("open"));
      await press();
      await page.waitForSelector(`${id}[aria-invalid]`);
      assert.match(await page.textContent("#problems"), words);
      assert.ok(await field.isVisible());
      assert.ok(await field.evaluate((one) => one === document.activeElement));
      await field.evaluate((one) => {
        one.value = "";
        one.dispatchEvent(new Event("input"));
      });
      assert.equal(await field.getAttribute("aria-invalid"), null);
    };
    const improve = () => page.click("#improve button[type=submit]");
    await refused("#improve-facesMin", "1.5", /Faces min: 1.5 is not accepted; accepted is a whole number from 0 to 4294967295/, improve);
    await refused("#improve-faces", "-5", /Faces: -5 is not accepted/, improve);
    await refused("#improve-faces", "1e30", /Faces: 1e30 is not accepted/, improve);
    await refused("#improve-featureAngle", "4e", /Feature angle: this is no number/, improve);
    await refused("#weld", "1e", /Weld: this is no number/, () => page.setInputFiles("#file", join(data, "bracket.stl")));
    assert.equal(sent, 0);
    page.off("request", count);
    // What the server refuses is pointed at as well.
    await page.fill("#weld", "-1");
    await page.setInputFiles("#file", join(data, "bracket.stl"));
    await page.waitForSelector("#weld[aria-invalid]");
    assert.match(await page.textContent("#problems"), /^INVALID_OPTION .*0 or more/);
    await page.fill("#weld", "");
    await page.click("#problems button");
  },

  async "improve, and what is drawn is what the server made"({ page, address }) {
    await run(page, "improve", { subdivisionSize: 4, tolerance: 0.2, faces: 12000 });
    await settled(page);
    assert.equal((await agrees(page, address)).result, 12000);
    assert.equal(await page.locator("#problems p").count(), 0);
  },

  async "down and up, within what is held and beyond"({ page, address }) {
    for (const share of [0.2, 0.05, 0, 0.4, 0.8, 1, 0.5]) {
      await slide(page, share);
      await settled(page);
      const { result } = await agrees(page, address);
      const ends = await page.$$eval("#faces-least, #faces-most", (both) => both.map((one) => Number(one.textContent.replace(/,/g, ""))));
      const note = await page.textContent("#resolution-note");
      assert.match(note, result === ends[0] ? /^The coarsest/ : result === ends[1] ? /^The finest/ : /^$/, `${result} of ${ends}`);
    }
  },

  async "a step of the slider sends faces, not the mesh"({ page }) {
    const before = (await shownOn(page)).result;
    await slide(page, 0.503);
    await settled(page);
    const after = (await shownOn(page)).result;
    assert.notEqual(after, before);
    const records = Number(/^(\d+) records/.exec(await page.getAttribute("#canvas", "data-step"))[1]);
    const faces = Number(/, (\d+) faces/.exec(await page.getAttribute("#canvas", "data-step"))[1]);
    assert.ok(records > 0 && faces < after / 3, `${records} records, ${faces} faces of ${after} drawn anew`);
  },

  async "colours, cut, views and places to look at"({ page }) {
    for (const colour of ["size", "valence", "stretch"]) {
      await page.selectOption("#colour", colour);
      await page.waitForFunction((word) => document.getElementById("legend").textContent.includes(word), { size: "longest edge", valence: "edges at", stretch: "stretch" }[colour]);
    }
    await page.selectOption("#cut-axis", "1");
    assert.ok(await page.isEnabled("#cut"));
    // The middle of the box, as its edges in the summary have it.
    const at = async () => Number(/^y = (-?[\d.e-]+)/.exec(await page.textContent("#cut-place"))[1]);
    const tall = Number(/× ([\d.]+) ×/.exec(await page.textContent("#summary"))[1]);
    const middle = await at();
    await page.fill("#cut", "1");
    assert.ok(Math.abs(await at() - middle - tall / 2) < tall / 500, `${await at()} is the end of ${tall} around ${middle}`);
    await page.fill("#cut", "0.5");
    await page.waitForTimeout(300);
    const half = await page.locator("#canvas canvas").screenshot();
    await page.click("#cut-flip");
    await page.waitForTimeout(300);
    assert.notDeepEqual(await page.locator("#canvas canvas").screenshot(), half);
    await page.click("#cut-flip");
    await page.selectOption("#cut-axis", "");
    const still = await page.locator("#canvas canvas").screenshot();
    await page.click("#worst li:first-child button");
    await page.waitForTimeout(300);
    assert.notDeepEqual(await page.locator("#canvas canvas").screenshot(), still);
    await page.focus("#canvas");
    await page.keyboard.press("f");
    await page.keyboard.press("ArrowLeft");
  },

  async "coloured by size, the legend is true of every face of input and result"({ page }) {
    await page.selectOption("#colour", "size");
    const before = await page.$eval("#faces", (slider) => Number(slider.value) / 1000);
    for (const [view, share] of [["both", 0], ["both", before], ["source", before], ["result", before], ["result", 0.02], ["both", before]]) {
      await page.selectOption("#view", view);
      await slide(page, share);
      await settled(page);
      // What is told in three digits may be a little beyond.
      const all = await page.$$eval(".spread tbody tr:nth-child(2) td", (cells) => cells.map((cell) => cell.textContent.split(" / ").map(Number)));
      const sizes = { both: all, source: [all[0]], result: [all[1]] }[view];
      const [low, high] = await page.$$eval("#legend span:not(.hint):not(.bar):not(.bar *)", (ends) => ends.map((end) => Number(end.textContent)));
      assert.equal(all.length, 2);
      for (const [least, , largest] of sizes) assert.ok(low <= least * 1.01 && largest <= high * 1.01, `${low} to ${high} for ${least} to ${largest}`);
      assert.ok(low * 2.01 >= Math.min(...sizes.map(([least]) => least)) && high <= 2.01 * Math.max(...sizes.map(([, , largest]) => largest)), `${low} to ${high} for ${sizes.join(" and ")}`);
    }
    await page.selectOption("#colour", "valence");
    assert.match(await page.textContent("#legend"), /≤ 3.*≥ 12/);
    await page.selectOption("#colour", "stretch");
  },

  async "a download is the mesh that is shown"({ page, address }) {
    const shown = await shownOn(page);
    await page.selectOption("#format", "OBJ");
    const [download] = await Promise.all([page.waitForEvent("download"), page.click("#download")]);
    const path = join(place, download.suggestedFilename());
    assert.equal(download.suggestedFilename(), `bracket-${shown.result}.obj`);
    await download.saveAs(path);
    const told = execFileSync(vsplit, ["info", path], { encoding: "utf8" });
    assert.match(told.replace(/,/g, ""), new RegExp(`faces\\s+${shown.result}\\b`));
    assert.ok(address);
  },

  async "control goes on from what is shown"({ page, address }) {
    await run(page, "control", { subdivisions: 0, tolerance: 0.2, maxValence: 9 });
    await page.waitForFunction(() => location.hash.includes("representation=r2"), null, { timeout: 60000 });
    await settled(page);
    await agrees(page, address);
  },

  async "faces that break a bound, and slivers, are flown to, at the resolution that has them"({ page, address }) {
    await run(page, "control", { minStretch: 0.5, maxValence: 7, maxSize: 3 });
    await page.waitForFunction(() => location.hash.includes("representation=r3"), null, { timeout: 60000 });
    await settled(page);
    const shown = await shownOn(page);
    const { faces, violations, slivers } = (await (await fetch(`${address}/v1/sessions/${shown.session}`)).json()).representations.find(({ id }) => id === "r3");
    assert.equal(faces, shown.result);
    const flown = async () => (await page.getAttribute("#canvas", "data-flown")).split(" ").map(Number);
    const near = (place, { x = 0, y = 0, z = 0 }) => place.every((v, axis) => Math.abs(v - [x, y, z][axis]) < 1e-4);
    const title = (cause) => cause.toLowerCase().replace(/_/g, " ");
    const notes = [["min_stretch not met", violations.find(({ bound }) => bound === "min_stretch").elements], [title(slivers[0].cause), slivers[0].elements]];
    const resting = () => page.waitForFunction(() => !/not known yet/.test(document.getElementById("notes").textContent));
    const { worstFaces } = await (await fetch(`${address}/v1/sessions/${shown.session}/quality?representation=r3&faces=${faces}&worst=1000`)).json();
    const go = async (note, n) => {
      await page.evaluate(() => delete document.getElementById("canvas").dataset.flown);
      await page.locator(`#notes .note:has(strong:text-is("${note}"))`).last().locator("button").nth(n).click();
      await page.waitForSelector("#canvas[data-flown]");
    };
    for (const [note, elements] of notes) {
      await slide(page, 0.3);
      await settled(page);
      assert.notEqual((await shownOn(page)).result, faces);
      await resting();
      const n = Math.min(3, elements.length - 1);
      const { centroid } = worstFaces.find((one) => (one.face ?? 0) === elements[n]);
      await go(note, n);
      assert.ok(near(await flown(), centroid), `${await flown()} where the server has ${JSON.stringify(centroid)}`);
      await settled(page);
      assert.equal((await shownOn(page)).result, faces);
    }
    const off = (await (await fetch(`${address}/v1/sessions/${shown.session}/mesh?representation=r3&faces=${faces}&format=OFF`)).text()).split("\n");
    const [x, y, z] = off[2 + violations.find(({ bound }) => bound === "max_valence").elements[0]].split(" ").map(Number);
    await go("max_valence not met", 0);
    assert.ok(near(await flown(), { x, y, z }), `${await flown()} where the file has ${[x, y, z]}`);
    await page.fill("#control-minStretch", "");
  },

  async "broken bounds are those of the resolution that is shown, also after a reload"({ page, address }) {
    const { result: asked } = await shownOn(page);
    const english = new Intl.NumberFormat("en");
    const isSaid = async () => {
      const { session, result } = await shownOn(page);
      const answer = await fetch(`${address}/v1/sessions/${session}:setResolution`, { method: "POST", headers: { "Content-Type": "application/json", Accept: "application/json" }, body: JSON.stringify({ representation: "r3", faces: result }) });
      const { violations } = await answer.json();
      assert.ok(violations.length > 0 && result !== asked);
      await page.waitForFunction((words) => document.getElementById("notes").textContent.startsWith(words), `The result, at ${english.format(result)} faces:`);
      for (const [n, { bound, count }] of violations.entries()) {
        const note = await page.locator("#notes .note.bad").nth(n).textContent();
        assert.ok(note.startsWith(`${bound} not met`) && note.includes(` ${english.format(count)} ${bound === "max_valence" ? "vert" : "face"}`), note);
      }
    };
    for (const share of [0.15, 0.9]) {
      await slide(page, share);
      await settled(page);
      await isSaid();
    }
    await page.reload();
    await page.waitForFunction(() => document.getElementById("canvas").dataset.result);
    await settled(page);
    await isSaid();
  },

  async "the session is there again after a reload"({ page, address }) {
    const before = await shownOn(page);
    await page.reload();
    await page.waitForFunction((faces) => Number(document.getElementById("canvas").dataset.result) === faces, before.result, { timeout: 30000 });
    await settled(page);
    assert.deepEqual(await agrees(page, address), before);
  },

  async "what is cancelled stops, and another method runs"({ page, address }) {
    await run(page, "improve", { subdivisionSize: 0.9, tolerance: 0.2, faces: 300000 });
    await page.click("#work .progress button");
    await page.waitForSelector("#problems p");
    assert.match(await page.textContent("#problems"), /^CANCELLED/);
    await run(page, "improve", { subdivisionSize: 8, tolerance: 0.2, faces: 6000 });
    await settled(page);
    await agrees(page, address);
  },

  async "by keyboard alone, the focus is never lost"({ page, address }) {
    const focused = () => page.evaluate(() => document.activeElement.closest("[id]").id + " " + document.activeElement.textContent);
    await page.evaluate(() => {
      window.lost = 0;
      const look = () => {
        if (document.activeElement === document.body) ++window.lost;
        if (window.lost >= 0) requestAnimationFrame(look);
      };
      document.getElementById("canvas").focus();
      look();
    });
    await page.focus("#improve button[type=submit]");
    await page.keyboard.press("Enter");
    assert.equal(await page.getAttribute("#improve button[type=submit]", "aria-disabled"), "true");
    assert.equal(await focused(), "improve Improve");
    await settled(page);
    assert.equal(await focused(), "improve Improve");
    await page.fill("#improve-faces", "300000");
    await page.fill("#improve-subdivisionSize", "0.9");
    await page.keyboard.press("Enter");
    await page.focus("#work .progress button");
    await page.keyboard.press("Enter");
    await page.waitForSelector("#problems p");
    await page.waitForSelector("#work .progress", { state: "detached" });
    assert.equal(await focused(), "improve Improve");
    await page.focus("#problems button");
    await page.keyboard.press("Enter");
    assert.equal(await focused(), "improve Improve");
    await page.fill("#improve-faces", "6000");
    await page.fill("#improve-subdivisionSize", "8");
    // A list that is made anew while one is in it.
    await page.focus("#worst li:nth-child(3) button");
    const before = await page.textContent("#worst li:first-child");
    await slide(page, 0.4);
    await page.waitForFunction((text) => document.querySelector("#worst li").textContent !== text, before);
    assert.match(await focused(), /^worst face /);
    // An upload that is given up.
    await page.route("**/v1/sessions?*", () => undefined);
    await page.focus("#samples button");
    await page.keyboard.press("Enter");
    await page.focus("#upload .progress button");
    await page.keyboard.press("Enter");
    await page.waitForSelector("#upload .progress", { state: "detached" });
    assert.match(await focused(), /^file /);
    await page.unroute("**/v1/sessions?*");
    await page.focus("#canvas");
    assert.equal(await page.getAttribute("#canvas", "role"), "application");
    const drawn = await page.locator("#canvas canvas").screenshot();
    await page.keyboard.press("ArrowLeft");
    await page.waitForTimeout(300);
    assert.notDeepEqual(await page.locator("#canvas canvas").screenshot(), drawn);
    assert.equal(await page.evaluate(() => [window.lost, (window.lost = -1)][0]), 0);
    await settled(page);
    await agrees(page, address);
  },

  async "another session in the address is opened, and the one before stays"({ page, address }) {
    const before = await shownOn(page);
    const status = async (id) => (await fetch(`${address}/v1/sessions/${id}`)).status;
    const name = (id) => page.evaluate((text) => (location.hash = text), `session=${id}`);
    const { id } = await (await fetch(`${address}/v1/sessions`, { method: "POST", headers: { "Content-Type": "application/octet-stream" }, body: readFileSync(openMesh()) })).json();
    await name(id);
    await page.waitForFunction(() => document.getElementById("canvas").dataset.source === "1102");
    assert.equal((await shownOn(page)).session, id);
    assert.equal(await status(before.session), 200);
    await name("nothing");
    await page.waitForSelector("#problems p");
    assert.match(await page.textContent("#problems"), /^NOT_FOUND no session "nothing"/);
    // Nothing of the session before is left to be taken for this one.
    assert.equal(await page.getAttribute("#improve button[type=submit]", "aria-disabled"), "true");
    assert.equal(await page.getAttribute("#download", "aria-disabled"), "true");
    assert.deepEqual(await page.$eval("#canvas", ({ dataset }) => [dataset.source, dataset.result]), [undefined, undefined]);
    assert.match(await page.textContent("#part"), /Session nothing is not open/);
    assert.ok(await page.isDisabled("#faces"));
    for (const id of ["summary", "legend"]) assert.equal(await page.textContent(`#${id}`), "");
    assert.doesNotMatch(await page.textContent("#figures"), /\d{3}/);
    await page.goBack();
    await page.goBack();
    await page.waitForFunction((faces) => Number(document.getElementById("canvas").dataset.result) === faces, before.result);
    await settled(page);
    assert.deepEqual(await agrees(page, address), before);
    assert.equal(await page.locator("#problems p").count(), 0);
  },

  async "what an address has opened is not deleted when another mesh is uploaded"({ page, address }) {
    const { id } = await (await fetch(`${address}/v1/sessions`, { method: "POST", headers: { "Content-Type": "application/octet-stream" }, body: readFileSync(openMesh()) })).json();
    await page.evaluate((text) => (location.hash = text), `session=${id}`);
    await page.waitForFunction(() => document.getElementById("canvas").dataset.source === "1102");
    await takeSample(page, "bracket.stl");
    await page.waitForTimeout(500);
    assert.equal((await fetch(`${address}/v1/sessions/${id}`)).status, 200);
    await fetch(`${address}/v1/sessions/${id}`, { method: "DELETE" });
  },

  async "a double click on a sample uploads once, and what was uploaded here before is deleted"({ page, address }) {
    const before = await shownOn(page);
    const posted = [];
    const note = (request) => request.method() === "POST" && posted.push(request.url());
    page.on("request", note);
    await takeSample(page, "scan.ply");
    await page.waitForTimeout(500);
    page.off("request", note);
    assert.equal(posted.length, 1, posted.join("\n"));
    assert.equal((await fetch(`${address}/v1/sessions/${before.session}`)).status, 404);
    const { session } = await shownOn(page);
    await page.reload();
    await page.waitForFunction(() => document.getElementById("canvas").dataset.source);
    assert.equal((await shownOn(page)).session, session);
    assert.equal((await fetch(`${address}/v1/sessions/${session}`)).status, 200);
    assert.equal(await page.locator("#problems p").count(), 0);
  },

  async "each sample gives a good mesh by its two buttons alone"({ page, address }) {
    // Of the bracket's forced slivers the sample's note speaks.
    for (const [name, slivers] of [["scan.ply", 0], ["bracket.stl", 6]]) {
      await takeSample(page, name);
      for (const verb of ["improve", "control"]) await page.click(`#${verb} button:text("Defaults")`);
      // A reload knows still what suits it.
      await page.reload();
      await page.waitForFunction(() => document.getElementById("canvas").dataset.source);
      assert.match(await page.textContent("#sample-note"), name === "scan.ply" ? /normal voting/ : /force slivers/);
      for (const verb of ["improve", "control"]) {
        assert.equal(await page.inputValue(`#${verb}-featureDetection`), name === "scan.ply" ? "NORMAL_VOTING" : "");
        for (const field of await page.locator(`#${verb} input[type=number]`).all()) assert.equal(await field.inputValue(), "");
        await page.click(`#${verb} button[type=submit]`);
        await page.waitForFunction((id) => location.hash.includes(`representation=${id}`), verb === "improve" ? "r1" : "r2", { timeout: 120000 });
        await settled(page);
        const { stretchMean, facesBelow02 = 0 } = await qualityOf(address, await agrees(page, address));
        assert.ok(stretchMean > 0.8 && facesBelow02 <= slivers, `${name}, ${verb}: mean stretch ${stretchMean}, ${facesBelow02} faces under 0.2`);
      }
      assert.equal(await page.locator("#problems p").count(), 0);
    }
  },

  async "a mesh that is no manifold is uploaded again with a repair, by a button"({ page }) {
    const path = join(place, "fan.off");
    // Three tetrahedra around the edge 0 1.
    const corners = ["0 0 0", "0 0 1"], faces = [];
    for (let n = 0; n < 3; ++n) {
      const at = corners.length;
      for (const turn of [2.1 * n, 2.1 * n + 1]) corners.push(`${Math.cos(turn)} ${Math.sin(turn)} 0.5`);
      faces.push([0, at, 1], [1, at, at + 1], [0, 1, at + 1], [0, at + 1, at]);
    }
    writeFileSync(path, `OFF\n${corners.length} ${faces.length} 0\n${corners.join("\n")}\n${faces.map((face) => `3 ${face.join(" ")}`).join("\n")}\n`);
    await upload(page, path);
    assert.match(await page.textContent("#summary"), /not a manifold, 0 boundary edges; 1\.\d+ × 1\.\d+ × 1 units/);
    // An edge of six faces is one edge.
    await page.waitForFunction(() => document.querySelector("#table tbody tr:nth-child(5) td").textContent === "7");
    await page.fill("#improve-faces", "7");
    await page.click("#improve button[type=submit]");
    await page.waitForSelector("#problems p");
    assert.match(await page.textContent("#problems"), /^NON_MANIFOLD/);
    const { session } = await shownOn(page);
    await page.click('#problems button:text("repair safe")');
    await page.waitForFunction((old) => new URLSearchParams(location.hash.slice(1)).get("session") !== old, session);
    assert.equal(await page.inputValue("#repair"), "SAFE");
    assert.match(await page.textContent("#summary"), /3 pieces, closed/);
    assert.equal(await page.locator('#notes :text("Not a manifold")').count(), 0);
    // What was typed is for this part still.
    assert.equal(await page.inputValue("#improve-faces"), "7");
    await page.selectOption("#repair", "NONE");
    await page.selectOption("#unit", "MILLIMETRE");
    await page.click("#apply");
    await page.waitForFunction(() => /not a manifold.* mm\.$/.test(document.getElementById("summary").textContent));
    await page.selectOption("#unit", "");
  },

  async "options that were typed for one part are not there for the next"({ page }) {
    await page.fill("#improve-tolerance", "0.123");
    await page.reload();
    await page.waitForFunction(() => document.getElementById("canvas").dataset.source);
    assert.equal(await page.inputValue("#improve-tolerance"), "0.123");
    await upload(page, join(data, "bracket.stl"));
    for (const name of ["tolerance", "faces"]) assert.equal(await page.inputValue(`#improve-${name}`), "");
    await run(page, "improve", { subdivisionSize: 8, faces: 6000 });
    await settled(page);
    // What was taken for what was left out stands in its field, and the bound beside what was measured.
    const placeholder = await page.getAttribute("#improve-maxDeviation", "placeholder");
    assert.match(placeholder, /^used \d/);
    assert.ok((await page.textContent("#table tbody tr:last-child td:last-child")).includes(`bound ${placeholder.slice(5)}`));
    const { result } = await shownOn(page);
    await slide(page, 0.2);
    await settled(page);
    assert.match(await page.textContent("#table tbody tr:last-child td:last-child"), new RegExp(`measured at ${new Intl.NumberFormat("en").format(result)} faces`));
  },

  async "open boundaries: nothing that closes them is drawn"({ page, address }) {
    await upload(page, openMesh());
    await run(page, "improve", { subdivisionSize: 1.5, tolerance: 0.05, faces: 900 });
    await settled(page);
    const shown = await agrees(page, address);
    for (const share of [0.1, 1, 0.6]) {
      await slide(page, share);
      await settled(page);
      await agrees(page, address);
    }
    assert.equal(shown.source, 1102);
  },

  async "light and dark"({ page }) {
    const ground = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
    const light = await ground();
    await page.click("#theme");
    assert.notEqual(await ground(), light);
  },

  async "a server that wants a token is given one"({ page }) {
    const made = execFileSync(vsplitd, ["--new-token", "ann:read-write"], { encoding: "utf8" }).trim().split("\n");
    const line = made.find((text) => /^ann\s+read-write\s+[0-9a-f]{64}$/.test(text));
    const token = made.map((text) => text.split(/\s+/).at(-1)).find((word) => !line.includes(word));
    const file = join(place, "tokens");
    writeFileSync(file, `${line}\n`, { mode: 0o600 });
    const guarded = await startServer(vsplitd, "--token-file", file);
    try {
      await page.goto(guarded.address);
      await page.waitForSelector("#improve button[type=submit]");
      await page.setInputFiles("#file", join(data, "bracket.stl"));
      await page.waitForSelector("#access:not([hidden])");
      assert.match(await page.textContent("#problems"), /^UNAUTHENTICATED/);
      await page.fill("#token", token);
      await page.press("#token", "Enter");
      assert.equal(await page.evaluate(() => document.activeElement.id), "file");
      await upload(page, join(data, "bracket.stl"));
      await run(page, "improve", { subdivisionSize: 8, tolerance: 0.2, faces: 6000 });
      await settled(page);
      await page.selectOption("#format", "OFF");
      const [download] = await Promise.all([page.waitForEvent("download"), page.click("#download")]);
      assert.match(download.suggestedFilename(), /\.off$/);
    } finally {
      await guarded.stop();
    }
  },

  async "nothing went wrong on the way"({ said }) {
    // A browser says of every answer that is no 2xx that it failed to load.
    assert.deepEqual(said.filter((text) => !text.startsWith("Failed to load resource") && !text.includes("GL Driver Message (OpenGL, Performance")), []);
  },
};

const server = await startServer(vsplitd);
const opened = await openPage(server.address);
await runSteps(steps, { ...opened, address: server.address });
await opened.browser.close();
await server.stop();
rmSync(place, { recursive: true });
