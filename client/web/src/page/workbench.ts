import { fromJson, type JsonValue } from "@bufbuild/protobuf";
import { RepresentationSchema, type Representation, type Session } from "../gen/vsplit/v1/meshing_pb";
import type { ColourBy } from "../shared/colours";
import { Problem, problemText } from "../shared/problem";
import type { Element, Figures, News, Order, Patch, Point, ProblemText } from "../shared/protocol";
import { symbolOf } from "../shared/units";
import { readPlace, writePlace, type Place } from "./address";
import { deleteSession, getQuality, getSession, meshPath } from "./api";
import { Colouring } from "./colouring";
import { count, find, refill } from "./dom";
import { KeepAlive } from "./keep_alive";
import { legend } from "./legend";
import { findingList, resultNotes, worstList } from "./lists";
import { MeshWorker } from "./mesh_worker";
import { showProblem } from "./problems";
import { ProgressBar, workPlace } from "./progress";
import { qualityTable, spreadTable, stretchHistogram } from "./quality_panel";
import { ResolutionSlider } from "./resolution";
import type { Slot, View, Viewer } from "./viewer";

const worstFaces = 20;

export type Verb = "improve" | "control";
const runButton = (verb: Verb): HTMLElement => find(verb).querySelector<HTMLElement>("button[type=submit]")!;

/** For measurements: what the last change of resolution took. */
function stepText(patch: Patch): string {
  return `${patch.records} records, ${patch.positions.length / 9} faces, ${patch.milliseconds.toFixed(1)} ms`;
}

/** The session that is open: its two meshes, what is known of them, and what is shown. */
export class Workbench {
  private session: Session | undefined;
  /** Ids of sessions whose mesh was uploaded in this tab since it was loaded. */
  private readonly uploaded = new Set<string>();
  private readonly alive = new KeepAlive((problem) => this.changed(this.ready, problemText(problem)));
  private name = "";
  private sample: string | undefined;
  private made: Representation | undefined;
  private faces = 0;
  /** The resolution that the method was asked for: what it said is of that. */
  private at = 0;
  private centre: Point = [0, 0, 0];
  private diagonal = 1;
  private readonly figures: Partial<Record<Slot, Figures>> = {};
  private fresh = false;
  private verb: Verb = "improve";
  private running = false;
  private readonly colouring = new Colouring(() => this.recolour());
  private source = this.worker("source");
  private result = this.worker("result");
  private readonly progress = new ProgressBar(workPlace(), () => runButton(this.verb), () => this.result.tell({ kind: "cancel" }));
  private readonly slider = new ResolutionSlider((faces) => this.order({ kind: "faces", faces }));

  /** `changed`: when methods can be run or not. `opened`: when a session is, with the name of the sample that it has. */
  constructor(
    private readonly viewer: Viewer,
    private readonly changed: (ready: boolean, problem?: ProblemText) => void,
    private readonly opened: (sample: string | undefined) => void,
  ) {}

  /** Whether a method can be run. */
  get ready(): boolean {
    return this.session !== undefined && !this.result.busy;
  }

  /** Whether it is what an address names; that need not say everything. */
  isAt({ session, representation, faces }: Place): boolean {
    return session === this.session?.id && [undefined, this.made?.id].includes(representation) && [undefined, this.faces].includes(faces);
  }

  /** What the address names, if it is still there. */
  async reopen(): Promise<void> {
    const place = readPlace();
    if (!place.session) return;
    const session = await getSession(place.session);
    if (readPlace().session !== place.session) return; // another was opened meanwhile
    this.open(session, place.name ?? "", place.sample);
    const made = session.representations.find((one) => one.id === place.representation) ?? session.representations.at(-1);
    if (!made) return;
    this.made = made;
    this.at = made.faces;
    this.writePlace(place.faces ?? made.faces);
    this.showNotes();
    this.order({ kind: "open", session: session.id, representation: made.id, faces: place.faces ?? made.faces, centre: this.centre });
  }

  /** A session whose mesh was just uploaded, instead of the one before, which goes if it was uploaded here: whatever an address
   * has opened is somebody else's too. */
  replace(session: Session, name: string, sample?: string): void {
    const before = this.session?.id;
    this.open(session, name, sample);
    // One that cannot be deleted ends when its time is over.
    if (before && this.uploaded.delete(before)) deleteSession(before).catch(() => undefined);
    this.uploaded.add(session.id);
  }

  private open(session: Session, name: string, sample: string | undefined): void {
    if (!session.source) throw new Problem({ cause: "EMPTY_INPUT", detail: `session ${session.id} has no mesh; upload one` });
    this.source.end();
    this.result.end();
    this.source = this.worker("source");
    this.result = this.worker("result");
    this.session = session;
    this.alive.watch(session);
    this.colouring.clear();
    this.name = name;
    this.sample = sample;
    this.made = undefined;
    this.running = false;
    delete this.figures.source;
    delete this.figures.result;
    this.viewer.clear("source");
    this.viewer.clear("result");
    this.slider.off();
    find("stage").setAttribute("aria-busy", "false");
    const box = session.source!.boundingBox!;
    const low = [box.min!.x, box.min!.y, box.min!.z], high = [box.max!.x, box.max!.y, box.max!.z];
    this.centre = low.map((v, axis) => (v + high[axis]!) / 2) as unknown as Point;
    const half = low.map((v, axis) => (high[axis]! - v) / 2) as unknown as Point;
    this.diagonal = 2 * Math.hypot(...half);
    this.viewer.frame(half);
    this.source.tell({ kind: "source", path: meshPath(session.id, "", 0, "PLY"), centre: this.centre });
    this.writePlace();
    this.showSummary();
    this.showNotes();
    this.showQuality();
    void this.showWorst();
    this.opened(sample);
    this.changed(true);
  }

  run(verb: Verb, options: object): void {
    if (!this.session) return;
    this.verb = verb;
    this.running = true;
    const body: Record<string, unknown> = { options };
    // Control is for meshes that were improved; improve begins anew.
    if (verb === "control" && this.made) body["source"] = { representation: this.made.id, faces: this.faces };
    this.changed(false);
    this.slider.off();
    this.progress.show("queued", 0);
    this.order({ kind: "method", path: `/v1/sessions/${this.session.id}:${verb}`, body, centre: this.centre });
  }

  colour(by: ColourBy): void {
    this.colouring.choose(by);
  }

  show(view: View): void {
    this.colouring.show(view);
  }

  /** Where the mesh that is shown can be had as a file. */
  file(format: string): string | undefined {
    return this.session ? meshPath(this.session.id, this.made?.id ?? "", this.faces, format) : undefined;
  }

  private recolour(): void {
    const { by, range } = this.colouring;
    for (const worker of [this.source, this.result]) worker.tell({ kind: "colour", by, range });
    if (this.session) find("legend").replaceChildren(legend(by, range, this.unit));
  }

  private order(order: Order): void {
    find("stage").setAttribute("aria-busy", "true");
    this.result.tell(order);
  }

  private worker(slot: Slot): MeshWorker {
    const own: MeshWorker = new MeshWorker((news) => {
      // What an older worker still had to say is about another mesh.
      if (own === this[slot]) this.hear(slot, news);
    });
    return own;
  }

  private hear(slot: Slot, news: News): void {
    switch (news.kind) {
      case "patch":
        this.colouring.take(slot, news.patch);
        if (slot === "source") {
          this.viewer.apply(slot, news.patch);
        } else {
          this.draw(news.patch);
          this.faces = news.patch.visible;
          this.slider.tell(this.faces);
          if (news.patch.records > 0) find("canvas").dataset["step"] = stepText(news.patch);
        }
        return;
      case "figures":
        this.figures[slot] = news.figures;
        this.colouring.measured(slot, news.figures.sizes);
        this.showQuality();
        if (slot === "result" && this.made) this.settle();
        return;
      case "progress":
        performance.mark("vsplit method ended"); // unless another comes
        this.fresh = true;
        return this.progress.show(news.stage, news.fraction, news.faces);
      case "place":
        return this.fly("result", news.place, news.size);
      case "representation":
        return this.take(fromJson(RepresentationSchema, news.json as JsonValue));
      case "problem":
        showProblem(news.problem);
        return this.changed(this.ready, news.problem);
      case "idle":
        if (slot === "source" || this.result.busy) return;
        this.running = false;
        find("stage").setAttribute("aria-busy", "false");
        this.progress.hide();
        if (this.made) this.slider.set(this.made.facesMin, this.made.facesMax, this.faces);
        return this.changed(this.ready);
    }
  }

  private take(made: Representation): void {
    const another = made.id !== this.made?.id;
    // Other resolutions come without what was measured at the one asked for.
    if (another) this.at = made.faces;
    this.made = another ? made : Object.assign(this.made!, { facesMin: made.facesMin, facesMax: made.facesMax });
    this.slider.set(made.facesMin, made.facesMax, made.faces);
    this.showNotes();
    this.showQuality();
    this.settle();
  }

  /** With marks in the browser's timeline: what a change costs, and when it is seen. */
  private draw(patch: Patch): void {
    const begun = performance.now();
    this.viewer.apply("result", patch);
    performance.measure("vsplit copied", { start: begun });
    const first = this.fresh;
    this.fresh = false;
    void this.viewer.afterDraw().then(() => {
      if (first) performance.mark("vsplit drawn first");
      performance.mark("vsplit drawn");
    });
  }

  /** The mesh stays as it is for now: the address names it, and its worst faces are asked for. */
  private settle(): void {
    this.writePlace(this.faces);
    void this.showWorst();
  }

  private writePlace(faces?: number): void {
    const { name, sample } = this;
    writePlace({ session: this.session!.id, representation: this.made?.id, faces, name, sample });
  }

  private async showWorst(): Promise<void> {
    const session = this.session!.id, made = this.made?.id ?? "", faces = this.faces;
    const isShown = (): boolean => session === this.session?.id && made === (this.made?.id ?? "") && (!made || faces === this.faces);
    try {
      const quality = await getQuality(session, made, faces, worstFaces);
      if (!isShown()) return;
      refill(find("worst"), worstList(quality.worstFaces, (place, size) => this.fly(made ? "result" : "source", place, size)));
    } catch (error) {
      if (isShown()) showProblem(problemText(error));
    }
  }

  /** To an element of the resolution that the method was asked for: it may not be there at others. */
  private locate(element: Element): void {
    if (this.running) showProblem({ cause: "BUSY", detail: "a method runs; the mesh stays as it is until its result comes" });
    else this.order({ kind: "locate", faces: this.at, element });
  }

  private fly(slot: Slot, place: Point, size: number): void {
    find("canvas").dataset["flown"] = place.join(" ");
    this.viewer.fly(slot, place.map((v, axis) => v - this.centre[axis]!) as unknown as Point, size);
  }

  private showQuality(): void {
    const columns = { ...this.figures, deviation: this.made && this.at === this.faces ? this.made.quality?.deviationMax : undefined, unit: this.unit };
    find("table").replaceChildren(qualityTable(columns), spreadTable(columns));
    find("histogram").replaceChildren(stretchHistogram(columns));
  }

  private showNotes(): void {
    const findings = findingList(this.session?.source?.findings ?? [], this.diagonal / 100, (place, size) => this.fly("source", place, size));
    const notes = [...(this.made ? resultNotes(this.made, this.at, (element) => this.locate(element)) : []), ...findings];
    refill(find("notes"), ...(notes.length > 0 ? notes : ["Nothing to report."]));
  }

  /** Of lengths. */
  private get unit(): string {
    return symbolOf(this.session?.source?.unit);
  }

  private showSummary(): void {
    const { source } = this.session!;
    const kind = source!.closed ? `closed, genus ${source!.genus}` : `${count(source!.boundaryEdges)} boundary edges`;
    const pieces = source!.components === 1 ? "1 piece" : `${count(source!.components)} pieces`;
    find("part").textContent = this.name || `session ${this.session!.id}`;
    find("summary").textContent = `${count(source!.faces)} faces, ${count(source!.vertices)} vertices; ${pieces}, ${kind}${this.unit ? `; lengths in ${this.unit}` : ""}.`;
  }
}
