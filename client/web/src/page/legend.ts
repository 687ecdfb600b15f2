import { Ramp, type ColourBy, type Range } from "../shared/colours";
import { element, figure } from "./dom";

const steps = 24;

/** What faces and vertices are measured by. */
export const meanings: Readonly<Record<ColourBy, string>> = {
  stretch: "Stretch of a face: √12 × radius of its inscribed circle / its longest edge. 1 is equilateral, 0 degenerate; under 0.2 unfit for solvers.",
  size: "Size of a face: its longest edge.",
  valence: "Valence of a vertex: edges that meet there. 6 is regular inside a surface.",
};

/** What the colours mean; lengths are in `unit`, empty where it is not known. */
export function legend(by: ColourBy, range: Range, unit: string): HTMLElement {
  const ramp = new Ramp(by, range);
  const bar = element("span", { class: "bar", "aria-hidden": "true" });
  const [low, high] = range;
  for (let n = 0; n < steps; ++n) {
    const part = element("span");
    part.style.background = ramp.cssAt((n + 0.5) / steps);
    bar.append(part);
  }
  const words = { stretch: "stretch, 1 is best; red under 0.2", size: `longest edge, ${unit || "model units"}; log scale`, valence: "edges at a vertex" }[by];
  // Stretch has these bounds, and sizes reach from the one to the other; a valence may be beyond.
  const [from, to] = by === "valence" ? [`≤ ${low}`, `≥ ${high}`] : [figure(low, 3), figure(high, 3)];
  return element("div", {}, element("span", {}, from), bar, element("span", {}, to), element("span", { class: "hint", title: meanings[by] }, words));
}
