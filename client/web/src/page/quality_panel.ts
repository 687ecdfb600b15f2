import type { Figures, Spread } from "../shared/protocol";
import { Ramp } from "../shared/colours";
import { withUnit } from "../shared/units";
import { count, counted, element, figure } from "./dom";
import { meanings } from "./legend";

/** Distance of the result to the source. */
export interface Deviation {
  measured: number;
  /** What the method was to keep. */
  bound?: number;
  /** Faces of the resolution that it was measured at, where another is shown. */
  at?: number;
}

export interface Columns {
  source?: Figures;
  result?: Figures;
  deviation?: Deviation;
  /** Of lengths; empty where it is not known. */
  unit: string;
}

const rows: [string, (f: Figures, unit: string) => string][] = [
  ["Faces", (f) => count(f.faces)],
  ["Stretch, mean", (f) => f.stretchMean.toFixed(3)],
  ["Stretch, min", (f) => f.stretchMin.toFixed(3)],
  ["Faces under 0.2", (f) => count(f.facesBelow02)],
  ["Valence, max", (f) => count(f.valenceMax)],
  ["Size, max", (f, unit) => withUnit(figure(f.sizeMax), unit)],
];

/** What the figures mean, folded away. */
export function glossary(): HTMLElement {
  const deviation = "Deviation: largest distance of the result to the input and of the input to the result.";
  return element("details", {}, element("summary", {}, "What these are"), ...[...Object.values(meanings), deviation].map((words) => element("p", { class: "hint" }, words)));
}

export function qualityTable({ source, result, deviation, unit }: Columns): HTMLElement {
  const cell = (figures: Figures | undefined, text: (f: Figures, unit: string) => string): HTMLElement =>
    element("td", {}, figures ? text(figures, unit) : "–");
  const body = element("tbody");
  for (const [name, text] of rows) body.append(element("tr", {}, element("th", { scope: "row" }, name), cell(source, text), cell(result, text)));
  const distance = element("td", {}, deviation ? withUnit(figure(deviation.measured), unit) : "–");
  if (deviation?.bound !== undefined) distance.append(element("span", { class: "aside" }, `bound ${withUnit(figure(deviation.bound), unit)}`));
  if (deviation?.at !== undefined) distance.append(element("span", { class: "aside" }, `measured at ${counted(deviation.at, "face")}`));
  body.append(element("tr", {}, element("th", { scope: "row" }, "Deviation, max"), element("td", {}, "–"), distance));
  const head = element("tr", {}, element("td"), element("th", { scope: "col" }, "Input"), element("th", { scope: "col" }, "Result"));
  return element("table", { "aria-labelledby": "quality-title" }, element("thead", {}, head), body);
}

const spreads: [string, keyof Figures["spread"]][] = [
  ["Stretch", "stretch"],
  ["Size", "size"],
  ["Valence", "valence"],
];

/** Least, mean and largest of what faces and vertices are measured by. */
export function spreadTable({ source, result, unit }: Columns): HTMLElement {
  const words = (value: number, of: keyof Figures["spread"]): string => (of === "stretch" ? value.toFixed(2) : figure(value, 3));
  const text = (spread: Spread, of: keyof Figures["spread"]): string => spread.map((value) => words(value, of)).join(" / ");
  const cell = (figures: Figures | undefined, of: keyof Figures["spread"]): HTMLElement => element("td", {}, figures ? text(figures.spread[of], of) : "–");
  const body = element("tbody");
  for (const [name, of] of spreads) body.append(element("tr", {}, element("th", { scope: "row" }, withUnit(name, of === "size" ? unit : "")), cell(source, of), cell(result, of)));
  const head = element("tr", {}, element("td"), element("th", { scope: "col" }, "Input"), element("th", { scope: "col" }, "Result"));
  return element("table", { class: "spread" }, element("caption", {}, "Min / mean / max"), element("thead", {}, head), body);
}

const width = 300, height = 110, foot = 16, bins = 20;
const svg = "http://www.w3.org/2000/svg";

function shape(tag: string, attributes: Record<string, string | number>, text = ""): SVGElement {
  const made = document.createElementNS(svg, tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, String(value));
  made.textContent = text;
  return made;
}

/** Shares of faces by stretch: the input as an outline, the result as bars, and the line at 0.2. */
export function stretchHistogram({ source, result }: Columns): HTMLElement {
  const drawing = shape("svg", { viewBox: `0 0 ${width} ${height}`, role: "img" });
  const shares = (f: Figures | undefined): number[] => (f && f.faces > 0 ? f.histogram.map((n) => n / f.faces) : []);
  const before = shares(source), after = shares(result);
  const most = Math.max(0.05, ...before, ...after);
  const y = (share: number): number => (height - foot) * (1 - share / most);
  const x = (bin: number): number => (bin * width) / bins;
  const ramp = new Ramp("stretch", [0, 1]);
  after.forEach((share, bin) => {
    drawing.append(shape("rect", { x: x(bin) + 1, y: y(share), width: width / bins - 2, height: height - foot - y(share), fill: ramp.css((bin + 0.5) / bins) }));
  });
  if (before.length > 0) {
    const steps = before.map((share, bin) => `V${y(share)}H${x(bin + 1)}`).join("");
    drawing.append(shape("path", { d: `M0 ${height - foot}${steps}V${height - foot}`, class: "outline" }));
  }
  drawing.append(shape("line", { x1: x(4), x2: x(4), y1: 0, y2: height - foot, class: "floor" }));
  drawing.append(shape("line", { x1: 0, x2: width, y1: height - foot, y2: height - foot, class: "axis" }));
  for (const value of [0, 0.2, 0.4, 0.6, 0.8, 1]) {
    drawing.append(shape("text", { x: x(value * bins), y: height - 3, "text-anchor": value === 0 ? "start" : value === 1 ? "end" : "middle" }, String(value)));
  }
  const below = (f: Figures | undefined): string => (f ? `${((100 * f.facesBelow02) / Math.max(1, f.faces)).toFixed(2)} %` : "none");
  drawing.setAttribute("aria-label", `Histogram of stretch. Under 0.2: input ${below(source)}, result ${below(result)}`);
  const caption = element("p", { class: "hint" }, "Share of faces by stretch: bars the result, outline the input; left of the line unfit for solvers.");
  const box = element("figure");
  box.append(drawing, caption);
  return box;
}
