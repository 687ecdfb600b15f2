// everyone_test.mjs VSPLITD DATA: the page on a phone, at 200 %, by keyboard, by ear, in light and dark.
import assert from "node:assert/strict";
import { join } from "node:path";
import { openPage, run, runSteps, settled, startServer, takeSample, upload } from "./browser.mjs";

const [vsplitd, data] = process.argv.slice(2);

/** Everything that can be there: what is folded, hidden or comes with a problem. */
async function unfold(page) {
  await page.setInputFiles("#file", { name: "bad.stl", mimeType: "", buffer: Buffer.from("solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0\n") });
  await page.waitForSelector("#problems p");
  await page.evaluate(() => {
    for (const one of document.querySelectorAll("details")) one.open = true;
    document.getElementById("access").hidden = false;
    document.querySelector(".help").hidden = false;
  });
}

/** Texts of less than 4.5 to 1, and borders of fields of less than 3 to 1 (WCAG 1.4.3, 1.4.11), but for what is disabled. */
const tooFaint = (page) =>
  page.evaluate(() => {
    const paint = document.createElement("canvas").getContext("2d", { willReadFrequently: true });
    const parse = (colour) => {
      paint.clearRect(0, 0, 1, 1);
      paint.fillStyle = colour;
      paint.fillRect(0, 0, 1, 1);
      const [r, g, b, a] = paint.getImageData(0, 0, 1, 1).data;
      return [r, g, b, a / 255];
    };
    const light = (rgb) => {
      const [r, g, b] = rgb.map((v) => (v / 255 <= 0.03928 ? v / 255 / 12.92 : ((v / 255 + 0.055) / 1.055) ** 2.4));
      return 0.2126 * r + 0.7152 * g + 0.0722 * b;
    };
    const over = (top, under) => top.slice(0, 3).map((v, n) => v * top[3] + under[n] * (1 - top[3]));
    const ground = (one) => {
      const layers = [];
      for (let at = one; at; at = at.parentElement) layers.unshift(parse(getComputedStyle(at).backgroundColor));
      return layers.reduce((under, layer) => over(layer, under), [255, 255, 255]);
    };
    const ratio = (top, under) => {
      const [low, high] = [light(over(parse(top), under)), light(under)].sort((a, b) => a - b);
      return (high + 0.05) / (low + 0.05);
    };
    const faint = [];
    let looked = 0;
    const look = (name, colour, under, least) => {
      ++looked;
      const found = ratio(colour, under);
      if (found < least) faint.push(`${name}: ${found.toFixed(2)}`);
    };
    for (const one of document.querySelectorAll("body *")) {
      const isField = one.matches("input, select");
      const hasText = [...one.childNodes].some((node) => node.nodeType === Node.TEXT_NODE && node.textContent.trim());
      if (!(isField || hasText) || one.getClientRects().length === 0 || one.closest('[aria-disabled="true"]') || one.matches(":disabled")) continue;
      const style = getComputedStyle(one), inDrawing = one instanceof SVGElement;
      const name = one.id || `${one.tagName} "${one.textContent.trim().slice(0, 20)}"`;
      const under = ground(inDrawing ? one.closest("figure") : one);
      look(name, inDrawing ? style.fill : style.color, under, 4.5);
      if (one.placeholder) look(`${name}'s placeholder`, getComputedStyle(one, "::placeholder").color, under, 4.5);
      if (isField && !["range", "checkbox", "file"].includes(one.type)) look(`${name}'s border`, style.borderTopColor, ground(one.parentElement), 3);
    }
    return { faint, looked };
  });

const steps = {
  async "every control and region has a name for those who listen"({ page, context }) {
    await upload(page, join(data, "bracket.stl"));
    await run(page, "improve", { subdivisionSize: 8, tolerance: 0.2, faces: 6000 });
    await settled(page);
    await unfold(page);
    const browser = await context.newCDPSession(page);
    const { nodes } = await browser.send("Accessibility.getFullAXTree");
    const named = ["button", "textbox", "combobox", "slider", "spinbutton", "checkbox", "link", "application", "progressbar", "img", "form", "region", "table"];
    const has = (node, property) => node.properties?.some(({ name, value }) => name === property && value.value);
    const due = nodes.filter((node) => !node.ignored && node.role?.value !== "RootWebArea" && (named.includes(node.role?.value) || has(node, "focusable")));
    const nameless = due.filter((node) => !node.name?.value.trim()).map((node) => `${node.role.value} ${JSON.stringify(node)}`);
    assert.deepEqual(nameless, []);
    assert.ok(due.length > 60, `${due.length} only`);
    // A unit is apart from what it is of.
    assert.ok(due.some(({ name }) => name.value === "Tolerance units"), due.map(({ name }) => name.value).join(", "));
  },

  async "texts and the borders of fields stand out, in light and dark"({ page }) {
    for (const theme of ["light", "dark"]) {
      assert.equal(await page.getAttribute("html", "data-theme"), theme);
      const { faint, looked } = await tooFaint(page);
      assert.deepEqual(faint, [], theme);
      assert.ok(looked > 100);
      await page.click("#theme");
    }
    await page.click("#problems button");
  },

  async "by keyboard one comes to everything, sees where one is, and comes out again"({ page }) {
    await page.evaluate(() => document.getElementById("access").setAttribute("hidden", ""));
    const ends = () => page.evaluate(() => document.activeElement === document.body);
    const due = await page.$$eval("a[href], button, input, select, summary, [tabindex]", (all) =>
      all.filter((one) => !one.disabled && one.checkVisibility()).map((one) => one.id || one.getAttribute("aria-label") || one.textContent));
    // From the very beginning.
    await page.evaluate(() => {
      const title = document.querySelector("h1");
      title.tabIndex = -1;
      title.focus();
    });
    const walk = async (key) => {
      const come = [];
      for (let n = 0; n < due.length; ++n) {
        await page.keyboard.press(key);
        if (await ends()) break;
        const { outlined, seen, name } = await page.evaluate(() => {
          const one = document.activeElement, box = one.getBoundingClientRect();
          return { outlined: getComputedStyle(one).outlineStyle !== "none", seen: box.bottom > 0 && box.top < innerHeight, name: one.id || one.getAttribute("aria-label") || one.textContent };
        });
        assert.ok(outlined && seen, `${name} has the focus and does not show it`);
        come.push(name);
      }
      return come;
    };
    const there = await walk("Tab");
    assert.deepEqual([...there].sort(), [...due].sort());
    const back = await walk("Shift+Tab");
    assert.deepEqual(back.reverse(), there.slice(0, -1));
  },

  async "nothing moves by itself"({ page }) {
    await page.emulateMedia({ reducedMotion: "reduce" });
    await page.click("#worst button");
    assert.equal(await page.evaluate(() => document.getAnimations().length), 0);
    const still = await page.evaluate(() => [...document.querySelectorAll("*")].filter((one) => getComputedStyle(one).transitionDuration !== "0s" || getComputedStyle(one).animationName !== "none").length);
    assert.equal(still, 0);
  },

  async "what runs is spoken of stage by stage, not number by number"({ page }) {
    const heard = await page.evaluate(async () => {
      const live = [...document.querySelectorAll("[aria-live]:not([aria-live=off]), [role=status], [role=alert]")];
      const said = [];
      const ears = live.map((place) => {
        const ear = new MutationObserver(() => said.push(place.textContent.trim()));
        ear.observe(place, { childList: true, subtree: true, characterData: true });
        return ear;
      });
      document.getElementById("improve-faces").value = "7000";
      document.querySelector("#improve button[type=submit]").click();
      const work = document.getElementById("work");
      while (work.childElementCount > 0) await new Promise((resolve) => setTimeout(resolve, 20));
      for (const ear of ears) ear.disconnect();
      return said;
    });
    assert.equal(heard[0], "Improve: Waiting for its turn");
    assert.ok(heard.includes("Improve: Simplifying") && heard.at(-1) === "Improve: ended", heard.join("; "));
    assert.deepEqual(heard, [...new Set(heard)]);
    await settled(page);
  },

  async "narrow, and at 200 %: all is within the page, and what happens is seen"({ page }) {
    for (const size of [{ width: 360, height: 740 }, { width: 320, height: 600 }, { width: 720, height: 430 }]) {
      await page.setViewportSize(size);
      await unfold(page);
      // The picture follows by a moment.
      await page.waitForFunction(() => document.querySelector("#canvas canvas").getBoundingClientRect().right <= document.documentElement.clientWidth + 1);
      const beyond = await page.evaluate(() => {
        const { clientWidth } = document.documentElement;
        return [...document.querySelectorAll("body *")]
          .filter((one) => !one.closest("svg"))
          .filter((one) => one.getBoundingClientRect().right > clientWidth + 1 || one.getBoundingClientRect().left < -1)
          .map((one) => `${one.tagName} ${one.id} ${one.className}`);
      });
      assert.deepEqual(beyond, [], JSON.stringify(size));
      await page.evaluate(() => document.getElementById("access").setAttribute("hidden", ""));
      await page.click("#problems button");
      const inView = (selector) => page.$eval(selector, (one) => {
        const { top, bottom } = one.getBoundingClientRect();
        return Math.min(bottom, innerHeight) - Math.max(top, 0) > 0.5 * Math.min(bottom - top, innerHeight);
      });
      // A place that is flown to from the foot of the page.
      await page.locator("#worst button").last().scrollIntoViewIfNeeded();
      assert.ok(!(await inView("#canvas")));
      await page.locator("#worst button").last().click();
      assert.ok(await inView("#canvas"));
      // A method that is begun there.
      await page.fill("#control-maxValence", String(8 + (size.width % 7)));
      await page.click("#control button[type=submit]");
      assert.ok(await inView("#work .progress"));
      await page.waitForSelector("#work .progress", { state: "detached", timeout: 60000 });
    }
  },

  async "lengths stand with the unit of the mesh"({ page }) {
    await page.setViewportSize({ width: 1440, height: 860 });
    const units = () => page.$$eval("#improve .unit", (all) => [...new Set(all.map((one) => one.textContent))].sort());
    assert.deepEqual(await units(), ["units", "°"]);
    await page.selectOption("#unit", "INCH");
    await upload(page, join(data, "bracket.stl"));
    assert.deepEqual(await units(), ["in", "°"]);
    assert.match(await page.textContent("#summary"), / × [\d.]+ in\./);
    await page.selectOption("#unit", "");
    await takeSample(page, "scan.ply");
    assert.deepEqual(await units(), ["units", "°"]);
  },

  async "nothing went wrong on the way"({ said }) {
    assert.deepEqual(said.filter((text) => !text.startsWith("Failed to load resource") && !text.includes("GL Driver Message (OpenGL, Performance")), []);
  },
};

const server = await startServer(vsplitd);
const opened = await openPage(server.address);
await runSteps(steps, opened);
await opened.browser.close();

// A browser without WebGL: nothing is drawn, and all else works.
const blind = await openPage(server.address, undefined, "--disable-gpu", "--disable-3d-apis");
await runSteps({
  async "without WebGL the page says so, and improves a mesh"({ page }) {
    assert.match(await page.textContent(".undrawn"), /draws no WebGL/);
    await upload(page, join(data, "bracket.stl"));
    await run(page, "improve", { subdivisionSize: 8, tolerance: 0.2, faces: 6000 });
    await settled(page);
    await page.waitForFunction(() => document.querySelector("#table tbody tr:first-child td:last-child").textContent === "6,000");
    await page.click("#worst button");
    await page.click("#fit");
    assert.equal(await page.locator("#problems p").count(), 0);
  },
}, blind);
await blind.browser.close();
await server.stop();
