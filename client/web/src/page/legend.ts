import { Ramp, type ColourBy } from "../shared/colours";
import { element, figure } from "./dom";

const steps = 24;

/** What the colours mean. */
export function legend(by: ColourBy, range: readonly [number, number]): HTMLElement {
  const ramp = new Ramp(by, range);
  const bar = element("span", { class: "bar", "aria-hidden": "true" });
  const [low, high] = range;
  for (let n = 0; n < steps; ++n) {
    const part = element("span");
    part.style.background = ramp.css(low + ((n + 0.5) / steps) * (high - low));
    bar.append(part);
  }
  const words = { stretch: "stretch", size: "longest edge, model units", valence: "edges at a vertex" }[by];
  const floor = by === "stretch" ? "; red under 0.2" : "";
  return element("div", {}, element("span", {}, figure(low, 3)), bar, element("span", {}, figure(high, 3)), element("span", { class: "hint" }, words + floor));
}
