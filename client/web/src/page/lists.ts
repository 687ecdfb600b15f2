import { toJson } from "@bufbuild/protobuf";
import { InterruptedMethodSchema, Method, type Finding, type InterruptedMethod, type Representation, type Vector, type Violation } from "../gen/vsplit/v1/meshing_pb";
import type { Element, Point, WorstFace } from "../shared/protocol";
import { count, counted, element, figure } from "./dom";
import type { Asked } from "./kept";

/** `size`: of what is to be seen there, where it is known. */
export type Fly = (place: Point, size?: number) => void;

/** Buttons a note has at most. */
const mostPlaces = 40;

const pointOf = (v: Vector | undefined): Point => [v?.x ?? 0, v?.y ?? 0, v?.z ?? 0];

/** The worst faces, each a button that flies there. */
export function worstList(faces: WorstFace[], fly: Fly): HTMLElement {
  if (faces.length === 0) return element("p", { class: "hint" }, "Nothing yet.");
  const list = element("ol", { class: "places" });
  for (const face of faces) {
    const go = element("button", { type: "button" }, `face ${count(face.face)}: stretch ${face.stretch.toFixed(3)}, size ${figure(face.size, 3)}`);
    go.addEventListener("click", () => fly(face.place, face.size));
    list.append(element("li", {}, go));
  }
  return list;
}

/** Buttons with numbers that fly to places. `names`: of all of them, for those who do not see. */
function placeButtons(names: string[], go: (n: number) => void): HTMLElement {
  const places = element("span", { class: "links" });
  names.slice(0, mostPlaces).forEach((name, n) => {
    places.append(element("button", { type: "button", class: "quiet", "aria-label": name, click: () => go(n) }, String(n + 1)));
  });
  return places;
}

/** A mesh that no method takes as it is, and what can be done. */
export function brokenNote(remedies: Node[]): HTMLElement {
  const words = element("p", {}, "Edges or vertices of more than one sheet: methods take no such mesh. Repair cuts the sheets apart (safe), and closes cracks and small holes too (full); it acts when the mesh is uploaded.");
  return element("div", { class: "note bad" }, element("strong", {}, "Not a manifold"), words, element("span", { class: "links" }, ...remedies));
}

/** What was found, with its places. */
export function findingList(findings: Finding[], fly: Fly): HTMLElement[] {
  return findings.map((finding) => {
    const names = finding.places.map((_, n) => `${finding.kind}, place ${n + 1}`);
    const places = placeButtons(names, (n) => fly(pointOf(finding.places[n])));
    return element("div", { class: "note" }, element("strong", {}, `${finding.kind.toLowerCase().replace(/_/g, " ")} × ${count(finding.count)}`), element("p", {}, finding.message), places);
  });
}

/** The bound of control that vertices break; the others are of faces. */
const ofVertices = "max_valence";

const countedElements = ({ bound, count: many }: Violation): string =>
  bound === "max_deviation" ? "the whole surface" : bound === ofVertices ? counted(many, "vertex", "vertices") : counted(many, "face");

/** What is amiss with a result: faces or vertices of it, each a button that goes there. */
function elementNote(title: string, words: string, of: Element["of"], numbers: number[], total: number, go: (element: Element) => void): HTMLElement {
  const names = numbers.map((number) => `${title}, ${of} ${count(number)}`);
  const places = placeButtons(names, (n) => go({ of, number: numbers[n]! }));
  const shown = places.childElementCount;
  const more = shown > 0 && shown < total ? element("p", {}, `The first ${shown} of ${count(total)}.`) : undefined;
  return element("div", { class: "note" }, element("strong", {}, title), element("p", {}, words), places, more);
}

/** Where the bounds are not known of the resolution that is shown: the server is being asked, or there is none to ask. */
export function unknownNote(faces: number, asked: boolean): HTMLElement {
  const why = asked ? "not known yet" : "not known; only a server can tell";
  return element("p", { class: "hint" }, `At ${counted(faces, "face")}, which are shown: whether the bounds hold is ${why}.`);
}

/** No bound is broken at the resolution that is shown. `at`: the one the method was asked for, of which more is known. */
export function clearNote({ faces, quality }: Representation, at: number): HTMLElement {
  const below = quality?.facesBelow02 ?? 0;
  const words = below > 0 ? `${counted(below, "face")} of stretch under 0.2; why, and the deviation, are` : "no bound on faces or vertices is broken; the deviation is";
  return element("p", { class: "hint" }, `At ${counted(faces, "face")}, which are shown: ${words} told at ${counted(at, "face")} only.`);
}

/** Bounds that a result breaks at one of its resolutions, and why slivers are left in it there. */
export function resultNotes(made: Representation, faces: number, go: (element: Element) => void): HTMLElement[] {
  const broken = made.violations.map((v) => {
    const words = `asked ${figure(v.limit)}, worst ${figure(v.worst)}, ${countedElements(v)}. ${v.reason}`;
    const note = elementNote(`${v.bound} not met`, words, v.bound === ofVertices ? "vertex" : "face", v.elements, v.count, go);
    note.classList.add("bad");
    return note;
  });
  const slivers = made.slivers.map((s) => elementNote(s.cause.toLowerCase().replace(/_/g, " "), s.message, "face", s.elements, s.count, go));
  const notes = [...broken, ...slivers];
  return notes.length > 0 ? [element("p", { class: "hint" }, `The result, at ${counted(faces, "face")}:`), ...notes] : [];
}

/** What was cut off, as it is to be asked for anew. */
export function askedOf(method: InterruptedMethod): Asked {
  const { source, improveOptions, controlOptions } = toJson(InterruptedMethodSchema, method) as Record<string, object>;
  return { verb: method.method === Method.CONTROL ? "control" : "improve", body: { source, options: improveOptions ?? controlOptions } };
}

/** Methods that the end of the server cut off, each with a button that asks for it anew. */
export function interruptedNotes(methods: InterruptedMethod[], ask: (method: InterruptedMethod) => void): HTMLElement[] {
  return methods.map((method) => {
    const name = method.method === Method.CONTROL ? "Control" : "Improve";
    const button = element("button", { type: "button", class: "quiet", click: () => ask(method) }, `Run ${name} again`);
    return element("div", { class: "note bad" }, element("strong", {}, `${name} was cut off`), element("p", {}, "The server ended while it ran; nothing of it is kept but what was asked for."), button);
  });
}
