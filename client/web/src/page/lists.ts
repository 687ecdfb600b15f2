import type { FaceQuality, Finding, Representation, Slivers, Vector } from "../gen/vsplit/v1/meshing_pb";
import type { Point } from "../shared/protocol";
import { count, element, figure } from "./dom";

export type Fly = (place: Point, size: number) => void;

const pointOf = (v: Vector | undefined): Point => [v?.x ?? 0, v?.y ?? 0, v?.z ?? 0];

/** The worst faces, each a button that flies there. */
export function worstList(faces: FaceQuality[], fly: Fly): HTMLElement {
  if (faces.length === 0) return element("p", { class: "hint" }, "Nothing yet.");
  const list = element("ol", { class: "places" });
  for (const face of faces) {
    const go = element("button", { type: "button" }, `face ${count(face.face)}: stretch ${face.stretch.toFixed(3)}, size ${figure(face.size, 3)}`);
    go.addEventListener("click", () => fly(pointOf(face.centroid), face.size));
    list.append(element("li", {}, go));
  }
  return list;
}

/** What was found, with its places. `size`: of what is around a place, where nothing tells. */
export function findingList(findings: Finding[], size: number, fly: Fly): HTMLElement[] {
  return findings.map((finding) => {
    const places = element("span", { class: "links" });
    finding.places.forEach((place, n) => {
      const go = element("button", { type: "button", class: "quiet", "aria-label": `${finding.kind}, place ${n + 1}` }, String(n + 1));
      go.addEventListener("click", () => fly(pointOf(place), size));
      places.append(go);
    });
    return element("div", { class: "note" }, element("strong", {}, `${finding.kind.toLowerCase().replace(/_/g, " ")} × ${count(finding.count)}`), element("p", {}, finding.message), places);
  });
}

function sliverNote(slivers: Slivers): HTMLElement {
  return element("div", { class: "note" }, element("strong", {}, slivers.cause.toLowerCase().replace(/_/g, " ")), element("p", {}, slivers.message));
}

/** Bounds that a result breaks at the resolution it was asked for, and why slivers are left in it there. */
export function resultNotes(made: Representation, faces: number): HTMLElement[] {
  const broken = made.violations.map((v) =>
    element("div", { class: "note bad" }, element("strong", {}, `${v.bound} not met`), element("p", {}, `asked ${figure(v.limit)}, worst ${figure(v.worst)}, ${count(v.count)} elements. ${v.reason}`)));
  const notes = [...broken, ...made.slivers.map(sliverNote)];
  return notes.length > 0 ? [element("p", { class: "hint" }, `The result, at ${count(faces)} faces:`), ...notes] : [];
}
