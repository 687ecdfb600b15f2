// vsplitd and a browser that looks at its page, for tests and measurements. Node finds playwright-core among the page's packages.
import { spawn } from "node:child_process";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";

const { chromium } = createRequire(new URL("../../../client/web/package.json", import.meta.url))("playwright-core");

/** Starts vsplitd on free ports, or at the one for HTTP that `options` name; `stop` ends it and fails where it does not end well. */
export async function startServer(vsplitd, ...options) {
  const http = options.includes("--http") ? [] : ["--http", "127.0.0.1:0"];
  const child = spawn(vsplitd, ["--listen", "127.0.0.1:0", ...http, "--log-level", "error", ...options], { stdio: ["ignore", "pipe", "inherit"] });
  const line = await new Promise((resolve, reject) => {
    child.stdout.once("data", (data) => resolve(String(data)));
    child.once("exit", (status) => reject(new Error(`vsplitd ended with ${status}`)));
  });
  const address = /and (http:\/\/\S+)/.exec(line)[1];
  const stop = () =>
    new Promise((resolve, reject) => {
      child.removeAllListeners("exit");
      child.once("exit", (status) => (status === 0 ? resolve() : reject(new Error(`vsplitd ended with ${status}`))));
      child.kill("SIGTERM");
    });
  const kill = () => new Promise((resolve) => child.removeAllListeners("exit").once("exit", resolve).kill("SIGKILL"));
  return { address, stop, kill };
}

/** A page in Debian's Chromium, drawn by software. `said`: what its console and errors told. */
export async function openPage(address, size = { width: 1440, height: 860 }, ...more) {
  const args = ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", ...more];
  const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args });
  const context = await browser.newContext({ viewport: size });
  const page = await context.newPage();
  const said = [];
  const asked = [];
  page.on("console", (message) => ["error", "warning"].includes(message.type()) && said.push(message.text()));
  page.on("pageerror", (error) => said.push(error.message));
  page.on("request", (request) => asked.push(request.url()));
  await page.goto(address);
  await page.waitForSelector("#improve button[type=submit]");
  return { browser, context, page, said, asked };
}

/** Runs steps one after the other until one fails; then the page is left as a picture, and this process fails. `given` goes to each. */
export async function runSteps(steps, given) {
  const { page, said } = given;
  try {
    for (const [name, step] of Object.entries(steps)) {
      const begun = performance.now();
      await step(given);
      console.log(`ok: ${name} (${Math.round(performance.now() - begun)} ms)`);
    }
  } catch (error) {
    const picture = join(tmpdir(), "vsplit-page-failed.png");
    await page.screenshot({ path: picture }).catch(() => undefined);
    console.error(`${error.stack}\nthe page said: ${said.join("\n")}\nand looked like ${picture}`);
    process.exitCode = 1;
  }
}

/** What the page shows and names in its address. */
export function shownOn(page) {
  return page.evaluate(() => {
    const canvas = document.getElementById("canvas").dataset;
    return { ...Object.fromEntries(new URLSearchParams(location.hash.slice(1))), source: Number(canvas.source), result: Number(canvas.result) };
  });
}

/** Waits until nothing runs and the address names what is shown. */
export async function settled(page, timeout = 60000) {
  await page.waitForFunction(
    () => {
      const faces = Number(document.getElementById("canvas").dataset.result);
      const said = new URLSearchParams(location.hash.slice(1));
      if (document.getElementById("stage").getAttribute("aria-busy") === "true") return false;
      return faces > 0 && !document.querySelector("#work .progress") && said.has("representation") && Number(said.get("faces")) === faces && !document.getElementById("faces").disabled;
    },
    null,
    { timeout },
  );
}

const sessionIn = (page) => page.evaluate(() => new URLSearchParams(location.hash.slice(1)).get("session"));

/** Waits until another session than `before` is drawn, or something is said. */
async function opened(page, before) {
  const isThere = (old) => {
    const said = new URLSearchParams(location.hash.slice(1));
    return (said.get("session") !== old && document.getElementById("canvas").dataset.source) || document.querySelector("#problems p");
  };
  await page.waitForFunction(isThere, before, { timeout: 60000 });
}

export async function upload(page, file) {
  const before = await sessionIn(page);
  await page.setInputFiles("#file", file);
  await opened(page, before);
}

/** Drops files and folders from the disk on the page, as from another window. */
export async function drop(page, ...paths) {
  const browser = await page.context().newCDPSession(page);
  const data = { items: [], files: paths, dragOperationsMask: 1 };
  for (const type of ["dragEnter", "dragOver", "drop"]) await browser.send("Input.dispatchDragEvent", { type, x: 100, y: 100, data });
  await browser.detach();
}

/** Takes a sample by a double click. */
export async function takeSample(page, name) {
  const before = await sessionIn(page);
  await page.dblclick(`#samples button:text("${name}")`);
  await opened(page, before);
}

export async function run(page, verb, options) {
  for (const [name, value] of Object.entries(options)) await page.fill(`#${verb}-${name}`, String(value));
  await page.click(`#${verb} button[type=submit]`);
}

/** Moves the slider of resolutions to a share of its way. */
export function slide(page, share) {
  return page.evaluate((value) => {
    const slider = document.getElementById("faces");
    slider.value = String(1000 * value);
    slider.dispatchEvent(new Event("input"));
  }, share);
}
