import { toJson } from "@bufbuild/protobuf";
import { anyUnpack } from "@bufbuild/protobuf/wkt";
import { ErrorInfoSchema } from "../gen/google/rpc/error_details_pb";
import type { Status } from "../gen/google/rpc/status_pb";
import { RecordEncoding, RepresentationSchema, type Representation } from "../gen/vsplit/v1/meshing_pb";
import { access, fields } from "../shared/access";
import { nothing, Ramp } from "../shared/colours";
import { fail, problemOf, problemText, Problem } from "../shared/problem";
import type { Element, News, Order, Patch, Point } from "../shared/protocol";
import { measure } from "./figures";
import { eventsOf } from "./frames";
import { BaseParts, type HeldMesh } from "./held_mesh";
import { boxOf, readMrr } from "./mrr_source";
import { Orders } from "./orders";
import { Painter } from "./painter";
import { placeOf } from "./places";
import { readPly } from "./ply";
import type { Surface } from "./surface";

const eventStream = "application/x-vsplit";
/** Positions to single precision are all that is drawn. */
const encoding = RecordEncoding.FLOAT32;
/** A look at all faces takes its time: not at every step of a slider. */
const figuresAfter = 150;

/** Why a stream ends that nobody wants any more; a stream that a user cancels ends otherwise. */
const superseded = Symbol("superseded");

const tell = (news: News, transfer: Transferable[] = []): void => self.postMessage(news, { transfer });

let surface: Surface | undefined;
let held: HeldMesh | undefined;
let opened: { session: string; representation: string } | undefined;
let ramp = new Ramp("stretch", [0, 1]);
let painter = new Painter([0, 0, 0], ramp);
let running: AbortController | undefined;
let timer: ReturnType<typeof setTimeout> | undefined;

/** A patch, and figures when no other has come for a moment. */
function draw(whole: boolean, begun: number, recordsBefore: number): void {
  tellPatch(whole, begun, recordsBefore);
  clearTimeout(timer);
  timer = setTimeout(tellFigures, figuresAfter);
}

function tellPatch(whole: boolean, begun: number, recordsBefore: number): void {
  if (!surface) return;
  const changes = held?.takeChanges();
  const painted = whole || !changes ? painter.whole(surface) : painter.some(surface, changes);
  const patch: Patch = {
    ...painted,
    slots: surface.faceCount,
    visible: held ? held.visible : surface.faceCount,
    milliseconds: performance.now() - begun,
    records: held ? Math.abs(held.mesh.records - recordsBefore) : 0,
  };
  tell({ kind: "patch", patch }, [painted.runs.buffer, painted.positions.buffer, painted.colours.buffer]);
}

function tellFigures(): void {
  if (surface) tell({ kind: "figures", figures: measure(surface) });
}

function problemIn(status: Status): Problem {
  for (const detail of status.details) {
    const info = anyUnpack(detail, ErrorInfoSchema);
    if (info) return new Problem({ cause: info.reason, detail: status.message, field: info.metadata["field"] });
  }
  return fail(status.message);
}

function hold(mesh: HeldMesh): void {
  held = mesh;
  surface = mesh.mesh;
}

async function take(path: string, body: object, centre: Point, signal: AbortSignal): Promise<Representation> {
  const response = await fetch(path, { method: "POST", headers: fields({ "Content-Type": "application/json", Accept: eventStream }), body: JSON.stringify(body), signal });
  if (!response.ok) throw await problemOf(response);
  let base = new BaseParts();
  for await (const { event } of eventsOf(response)) {
    signal.throwIfAborted();
    const begun = performance.now();
    const before = held?.mesh.records ?? 0;
    if (event.case === "progress") tell({ kind: "progress", stage: event.value.stage, fraction: event.value.fraction, faces: event.value.faces });
    if (event.case === "baseMesh") {
      const mesh = base.push(event.value);
      if (!mesh) continue;
      base = new BaseParts();
      hold(mesh);
      painter = new Painter(centre, ramp);
      draw(true, begun, 0);
    }
    if (event.case === "recordBlock") {
      held!.take(event.value);
      draw(false, begun, before);
    }
    if (event.case === "error") throw problemIn(event.value);
    if (event.case === "representation") return event.value;
  }
  throw fail("the stream ended without a representation");
}

async function stream(path: string, body: object, session: string, centre: Point): Promise<void> {
  running?.abort(superseded);
  const own = (running = new AbortController());
  const before = { surface, held, painter };
  try {
    const made = await take(path, { ...body, encoding: RecordEncoding[encoding] }, centre, own.signal);
    opened = { session, representation: made.id };
    show(made.faces);
    tell({ kind: "representation", json: toJson(RepresentationSchema, made) });
  } catch (error) {
    if (held !== before.held) goBack(before);
    if (error !== superseded) throw error;
  } finally {
    if (running === own) running = undefined;
  }
}

/** To the mesh before one that never was whole: what `opened` names goes with it. */
function goBack(before: { surface: Surface | undefined; held: HeldMesh | undefined; painter: Painter }): void {
  ({ surface, held, painter } = before);
  if (surface) {
    painter.ramp = ramp;
    return draw(true, performance.now(), held?.mesh.records ?? 0);
  }
  clearTimeout(timer);
  const empty = { runs: new Uint32Array(), positions: new Float32Array(), colours: new Uint8Array(), sizes: nothing };
  tell({ kind: "patch", patch: { ...empty, slots: 0, visible: 0, milliseconds: 0, records: 0 } });
}

function show(faces: number): void {
  const begun = performance.now();
  const before = held!.mesh.records;
  held!.show(faces);
  draw(false, begun, before);
}

/** Up or down among the records that are here; what is finer is asked for. */
async function goTo(faces: number, centre: Point): Promise<void> {
  if (!held) return;
  // Else what was asked for before would have the last word.
  running?.abort(superseded);
  show(faces);
  if (!opened || faces <= held.visibleHeld) return; // a file holds all it has
  const body = { representation: opened.representation, faces, resumeFrom: held.recordsHeld, facesHeld: held.recordsHeld === 0 ? held.visibleHeld : 0 };
  await stream(`/v1/sessions/${opened.session}:setResolution`, body, opened.session, centre);
}

/** Says nothing where the mesh is at another resolution in the end: another was asked for meanwhile. */
async function locate(faces: number, element: Element, centre: Point): Promise<void> {
  await goTo(faces, centre);
  const found = held?.visible === faces ? placeOf(held.mesh, element) : undefined;
  if (found) tell({ kind: "place", ...found });
}

async function openFile(file: Blob): Promise<void> {
  const read = async (share: number): Promise<void> => {
    tell({ kind: "progress", stage: "read", fraction: share, faces: 0 });
    await new Promise((resolve) => setTimeout(resolve));
  };
  const { held: mesh, description } = await readMrr(file, read);
  hold(mesh);
  const box = boxOf(mesh);
  centre = box.centre;
  painter = new Painter(centre, ramp);
  tell({ kind: "file", json: description, faces: mesh.visible, facesMin: mesh.visibleLeast, facesMax: mesh.visibleHeld, ...box });
  draw(true, performance.now(), mesh.mesh.records);
}

async function loadSource(path: string, centre: Point): Promise<void> {
  const response = await fetch(path, { headers: fields() });
  if (!response.ok) throw await problemOf(response);
  const begun = performance.now();
  surface = readPly(await response.arrayBuffer());
  painter = new Painter(centre, ramp);
  draw(true, begun, 0);
}

let centre: Point = [0, 0, 0];

async function obey(order: Order): Promise<void> {
  if ("centre" in order) centre = order.centre;
  switch (order.kind) {
    case "source":
      return loadSource(order.path, centre);
    case "method":
      return stream(order.path, order.body, order.path.split("/").at(-1)!.split(":")[0]!, centre);
    case "file":
      return openFile(order.file);
    case "open":
      return stream(`/v1/sessions/${order.session}:setResolution`, { representation: order.representation, faces: order.faces }, order.session, centre);
    case "faces":
      return goTo(order.faces, centre);
    case "locate":
      return locate(order.faces, order.element, centre);
    case "colour":
      painter.ramp = ramp = new Ramp(order.by, order.range);
      return tellPatch(true, performance.now(), held?.mesh.records ?? 0);
    case "token":
      access.token = order.token;
      return;
    case "cancel":
      running?.abort();
  }
}

async function carryOut(order: Order): Promise<void> {
  try {
    await obey(order);
  } catch (error) {
    tell({ kind: "problem", problem: problemText(error) });
  }
  tell({ kind: "idle" });
}

const orders = new Orders();
let due = false;

/** One order a turn of the event loop: those that came while it was busy come in before the next is taken. */
function carryOutNext(): void {
  if (due || orders.empty) return;
  due = true;
  setTimeout(() => {
    due = false;
    void carryOut(orders.take()!);
    carryOutNext();
  });
}

self.onmessage = ({ data }: MessageEvent<Order>) => {
  for (let dropped = orders.push(data); dropped > 0; --dropped) tell({ kind: "idle" });
  carryOutNext();
};
