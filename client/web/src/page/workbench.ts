import { fromJson, toJson, type JsonObject, type JsonValue } from "@bufbuild/protobuf";
import { RepresentationSchema, type Representation, type Session } from "../gen/vsplit/v1/meshing_pb";
import type { ColourBy } from "../shared/colours";
import { Problem, problemText } from "../shared/problem";
import type { Element, Figures, News, Order, Patch, Point, ProblemText } from "../shared/protocol";
import { symbolOf, withUnit } from "../shared/units";
import { readPlace, writePlace, type Place } from "./address";
import { deleteSession, getSession, meshPath, representationAt } from "./api";
import { Colouring } from "./colouring";
import { counted, figure, find, refill } from "./dom";
import { exact } from "./exact";
import { readFile, representationIn } from "./file_reader";
import { forget, keep, keptOf, type Asked, type Verb } from "./kept";
import { KeepAlive } from "./keep_alive";
import { legend } from "./legend";
import { askedOf, brokenNote, clearNote, findingList, interruptedNotes, resultNotes, unknownNote, worstList } from "./lists";
import { MeshWorker } from "./mesh_worker";
import { showProblem } from "./problems";
import { ProgressBar, workPlace } from "./progress";
import { qualityTable, spreadTable, stretchHistogram, type Deviation } from "./quality_panel";
import { ResolutionSlider } from "./resolution";
import { Resting } from "./resting";
import { fileSummary, isManifold, summaryOf } from "./summary";
import type { Slot, View, Viewer } from "./viewer";

const nothingOpen = "No mesh yet";
const verbNames: Record<Verb, string> = { improve: "Improve", control: "Control" };
const runButton = (verb: Verb): HTMLElement => find(verb).querySelector<HTMLElement>("button[type=submit]")!;

/** In the browser's timeline, once: the last time counts, and a page that stays open for days gathers nothing. */
function mark(name: string): void {
  performance.clearMarks(name);
  performance.mark(name);
}

/** For measurements: what the last change of resolution took. */
function stepText(patch: Patch): string {
  return `${patch.records} records, ${patch.positions.length / 9} faces, ${patch.milliseconds.toFixed(1)} ms`;
}

/** What is open, a session or a .vsplit file: its two meshes, what is known of them, and what is shown. */
export class Workbench {
  private session: Session | undefined;
  /** Whether the server has it no more. */
  private lost = false;
  /** Ids of sessions whose mesh was uploaded in this tab since it was loaded. */
  private readonly uploaded = new Set<string>();
  private readonly alive = new KeepAlive((problem) => this.tell(problem));
  private name = "";
  private sample: string | undefined;
  private made: Representation | undefined;
  private faces = 0;
  /** The resolution that the method was asked for: what it said is of that. */
  private at = 0;
  private centre: Point = [0, 0, 0];
  private half: Point = [0, 0, 0];
  private readonly figures: Partial<Record<Slot, Figures>> = {};
  private fresh = false;
  private verb: Verb = "improve";
  private running = false;
  /** What was cut off by a reload, and is asked for anew when what the address names is there. */
  private again: Asked | undefined;
  private readonly resting = new Resting((error) => this.heardOfRest(error));
  private readonly colouring = new Colouring(() => this.recolour());
  private source = this.worker("source");
  private result = this.worker("result");
  private readonly progress = new ProgressBar(workPlace(), () => runButton(this.verb), () => this.result.tell({ kind: "cancel" }));
  private readonly slider = new ResolutionSlider((faces) => this.order({ kind: "faces", faces }));

  /** What can be done where a mesh is no manifold: buttons, or words. */
  remedies: () => Node[] = () => [];

  /** `changed`: when methods can be run or not. `opened`: when a session is, with its unit of length and the name of the sample that it has. */
  constructor(
    private readonly viewer: Viewer,
    private readonly changed: (problem?: ProblemText) => void,
    private readonly opened: (session: string, unit: string, sample: string | undefined) => void,
  ) {}

  /** Whether a method can be run. */
  get ready(): boolean {
    return this.session !== undefined && !this.lost && !this.result.busy;
  }

  /** The open session's id. */
  get id(): string | undefined {
    return this.session?.id;
  }

  /** The options that the newest result of a method was made with, defaults filled in. */
  used(verb: Verb): JsonObject | undefined {
    const made = [this.made, ...(this.session?.representations ?? []).slice().reverse()];
    const all = made.map((one) => (one ? (toJson(RepresentationSchema, one) as JsonObject)[`${verb}Options`] : undefined));
    return all.find((options) => options !== undefined) as JsonObject | undefined;
  }

  /** Whether it is what an address names; that need not say everything. */
  isAt({ session, representation, faces }: Place): boolean {
    return session === this.session?.id && [undefined, this.made?.id].includes(representation) && [undefined, this.faces].includes(faces);
  }

  /** What the address names. Where that is not there nothing is open: what was shown before is something else. */
  async reopen(): Promise<void> {
    const place = readPlace();
    if (place.session !== this.session?.id || !place.session) this.close(place.session ? "Opening…" : nothingOpen);
    if (!place.session) return;
    let session: Session;
    try {
      session = await getSession(place.session);
      if (readPlace().session !== place.session) return; // another was opened meanwhile
      this.open(session, place.name ?? "", place.sample);
    } catch (error) {
      // What another token was shown is not for this one.
      const gone = !this.session || problemText(error).cause === "NOT_FOUND";
      if (gone && readPlace().session === place.session) this.close(`Session ${place.session} is not open`);
      throw error;
    }
    this.again = keptOf(session.id).method;
    const named = session.representations.find((one) => one.id === place.representation);
    if (place.representation && !named) showProblem({ cause: "NOT_FOUND", detail: `the session has no representation ${place.representation}; shown is the newest, or the input` });
    const made = named ?? session.representations.at(-1);
    if (!made) return this.goOn();
    this.made = made;
    this.at = made.faces;
    const faces = named && place.faces ? place.faces : made.faces;
    this.writePlace(faces);
    this.showNotes();
    this.order({ kind: "open", session: session.id, representation: made.id, faces, centre: this.centre });
  }

  /** A session whose mesh was just uploaded, instead of the one before, which goes if it was uploaded here: whatever an address
   * has opened is somebody else's too. */
  replace(session: Session, name: string, sample?: string): void {
    const before = this.session?.id;
    this.open(session, name, sample);
    if (!this.viewer.sees("source")) this.viewer.show("both");
    this.giveUp(before);
    this.uploaded.add(session.id);
  }

  /** A .vsplit file, read here and held here alone. What was open before stays until it is read. Rejects with a Problem. */
  async openFile(file: File, read: (share: number) => void, signal: AbortSignal): Promise<void> {
    const { by, range } = this.colouring;
    const { worker, news } = await readFile(file, { kind: "colour", by, range }, read, signal);
    const before = this.session?.id;
    this.close(file.name);
    this.giveUp(before);
    this.result.end();
    this.result = worker;
    worker.heard = (more) => this.hear("result", more);
    this.made = representationIn(news);
    this.faces = this.at = news.faces;
    this.resting.take(this.made);
    this.surround(news.centre, news.half);
    this.viewer.show("result");
    this.recolour();
    this.slider.set(news.facesMin, news.facesMax, news.faces);
    this.writePlace();
    find("summary").textContent = fileSummary(news.facesMin, news.facesMax, this.unit);
    this.showNotes();
  }

  /** Deletes a session that was uploaded here. One that cannot be deleted ends when its time is over. */
  private giveUp(session: string | undefined): void {
    if (!session || !this.uploaded.delete(session)) return;
    forget(session);
    deleteSession(session).catch(() => undefined);
  }

  /** Nothing is open. `title`: what is said instead of a name. */
  private close(title: string): void {
    if (this.made && !this.session) this.viewer.show("both"); // a file has no other side
    this.source.end();
    this.result.end();
    this.source = this.worker("source");
    this.result = this.worker("result");
    this.session = this.made = this.again = undefined;
    this.lost = this.running = false;
    this.faces = this.at = 0;
    this.name = "";
    this.sample = undefined;
    this.alive.end();
    this.resting.clear();
    delete this.figures.source;
    delete this.figures.result;
    this.load(false);
    this.colouring.clear();
    this.viewer.clear("source");
    this.viewer.clear("result");
    this.slider.off();
    this.progress.hide();
    find("stage").setAttribute("aria-busy", "false");
    find("legend").replaceChildren();
    find("part").textContent = title;
    find("summary").textContent = "";
    this.showNotes();
    this.showQuality();
    this.showWorst();
    this.changed();
  }

  private open(session: Session, name: string, sample: string | undefined): void {
    if (!session.source) throw new Problem({ cause: "EMPTY_INPUT", detail: `session ${session.id} has no mesh; upload one` });
    this.close(name || `session ${session.id}`);
    this.session = session;
    this.name = name;
    this.sample = sample;
    this.alive.watch(session);
    const { min, max } = session.source.boundingBox!;
    const low = [min!.x, min!.y, min!.z], high = [max!.x, max!.y, max!.z];
    this.surround(
      low.map((v, axis) => (v + high[axis]!) / 2) as unknown as Point,
      low.map((v, axis) => (high[axis]! - v) / 2) as unknown as Point,
    );
    this.load(true);
    this.source.tell({ kind: "source", path: meshPath(session.id, "", 0, "PLY"), centre: this.centre });
    this.recolour();
    this.writePlace();
    find("summary").textContent = summaryOf(session.source, this.unit);
    this.showNotes();
    this.opened(session.id, this.unit, sample);
    this.changed();
  }

  /** The input is on its way, or no more. */
  private load(is: boolean): void {
    find("canvas").toggleAttribute("data-loading", is);
  }

  /** The box around what is open: its middle, and half its edges. */
  private surround(centre: Point, half: Point): void {
    this.centre = centre;
    this.half = half;
    this.viewer.frame(half);
  }

  run(verb: Verb, options: object): void {
    const body: Record<string, unknown> = { options };
    // Control is for meshes that were improved; improve begins anew.
    if (verb === "control" && this.made) body["source"] = { representation: this.made.id, faces: this.faces };
    this.ask({ verb, body });
  }

  private ask({ verb, body }: Asked, note = ""): void {
    if (!this.session || this.lost) return;
    this.again = undefined;
    this.verb = verb;
    this.running = true;
    keep(this.session.id, { method: { verb, body } });
    this.slider.off();
    this.progress.title = `${verbNames[verb]}${note}: `;
    this.progress.show("queued", 0);
    this.order({ kind: "method", path: `/v1/sessions/${this.session.id}:${verb}`, body, centre: this.centre });
    this.changed();
  }

  /** The server ends a method whose client leaves, so one that ran at a reload is asked for anew. Where it came to its end, its
   * result is there, and is the answer. */
  private goOn(): void {
    if (this.again) this.ask(this.again, ", asked for anew");
  }

  /** The method has ended, so or so. */
  private ended(): void {
    if (this.running && this.session) keep(this.session.id, { method: undefined });
  }

  colour(by: ColourBy): void {
    this.colouring.choose(by);
  }

  show(view: View): void {
    this.colouring.show(view);
  }

  /** Where a cut is along an axis, at a share of the part, with its unit. */
  coordinate(axis: number, share: number): string {
    return withUnit(figure(this.centre[axis]! + (2 * share - 1) * this.half[axis]!), this.unit);
  }

  /** Name of a file of what is shown, without an ending: the part's and, of a result, its faces. */
  get fileStem(): string {
    const part = this.name.replace(/\.\w+$/, "") || "mesh";
    return this.made ? `${part}-${this.faces}` : part;
  }

  /** Where the mesh that is shown can be had as a file. */
  file(format: string): string | undefined {
    return this.session && !this.lost ? meshPath(this.session.id, this.made?.id ?? "", this.faces, format) : undefined;
  }

  private recolour(): void {
    const { by, range } = this.colouring;
    for (const worker of [this.source, this.result]) worker.tell({ kind: "colour", by, range });
    if (this.session || this.made) find("legend").replaceChildren(legend(by, range, this.unit));
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
          this.load(false);
        } else {
          this.draw(news.patch);
          const { visible } = news.patch;
          // What was said of the resolution before is not true of this one.
          const moved = visible !== this.faces;
          this.faces = visible;
          if (moved) this.showNotes();
          this.slider.tell(this.faces);
          if (news.patch.records > 0) find("canvas").dataset["step"] = stepText(news.patch);
        }
        return;
      case "figures":
        this.figures[slot] = news.figures;
        this.colouring.measured(slot, news.figures.sizes);
        this.showQuality();
        this.showWorst();
        if (slot === "result" && this.made) this.writePlace(this.faces);
        return this.askOfRest();
      case "progress":
        mark("vsplit method ended"); // unless another comes
        this.fresh = true;
        return this.progress.show(news.stage, news.fraction, news.faces);
      case "place":
        return this.fly("result", news.place, news.size);
      case "representation":
        this.ended();
        return this.take(fromJson(RepresentationSchema, news.json as JsonValue));
      case "problem":
        // A method that the end of a server cut off is asked for anew after a reload.
        if (slot === "result" && news.problem.cause !== "UNAVAILABLE") this.ended();
        if (slot === "source") this.load(false);
        return this.tell(news.problem);
      case "idle":
        if (slot === "source" || this.result.busy) return;
        this.running = false;
        find("stage").setAttribute("aria-busy", "false");
        this.progress.hide();
        if (this.made) this.slider.set(this.made.facesMin, this.made.facesMax, this.faces);
        this.changed();
        this.askOfRest();
        return this.goOn();
    }
  }

  private take(made: Representation): void {
    const another = made.id !== this.made?.id;
    // Other resolutions come without what was measured at the one asked for.
    if (another) this.at = made.faces;
    this.made = another ? made : Object.assign(this.made!, { facesMin: made.facesMin, facesMax: made.facesMax });
    this.resting.take(made);
    this.slider.set(made.facesMin, made.facesMax, made.faces);
    this.showNotes();
    this.showQuality();
    this.writePlace(this.faces);
  }

  /** Where the mesh stays at a resolution the server is asked for its figures and bounds; a file's are known of one alone. */
  private askOfRest(): void {
    const { session, made } = this;
    if (!session || !made || this.lost || this.result.busy || this.figures.result?.faces !== this.faces) return;
    this.resting.ask(this.faces, (faces, signal) => representationAt(session.id, made.id, faces, signal));
  }

  private heardOfRest(error: unknown): void {
    if (error !== undefined && problemText(error).field === "session") this.tell(problemText(error));
    this.showNotes();
    this.showQuality();
  }

  /** Something went wrong. What is held of a session that is gone stays to be looked at. */
  private tell(problem: ProblemText): void {
    showProblem(problem, ...(problem.cause === "NON_MANIFOLD" ? this.remedies() : []));
    if (problem.cause === "NOT_FOUND" && problem.field === "session" && this.session) {
      this.lost = true;
      this.ended();
      this.alive.end();
      find("summary").textContent = "The server has this session no more: shown is what came from it before. Upload the mesh again to go on.";
    }
    this.changed(problem);
  }

  /** With marks in the browser's timeline: what a change costs, and when it is seen. */
  private draw(patch: Patch): void {
    const begun = performance.now();
    this.viewer.apply("result", patch);
    performance.clearMeasures("vsplit copied");
    performance.measure("vsplit copied", { start: begun });
    const first = this.fresh;
    this.fresh = false;
    void this.viewer.afterDraw().then(() => {
      if (first) mark("vsplit drawn first");
      mark("vsplit drawn");
    });
  }

  private writePlace(faces?: number): void {
    const { name, sample } = this;
    writePlace(this.session ? { session: this.session.id, representation: this.made?.id, faces, name, sample } : {});
  }

  private showWorst(): void {
    const slot = this.made ? "result" : "source";
    refill(find("worst"), worstList(this.figures[slot]?.worst ?? [], (place, size) => this.fly(slot, place, size)));
  }

  /** To an element of a resolution: it may not be there at others. */
  private locate(element: Element, faces: number): void {
    if (this.running) showProblem({ cause: "BUSY", detail: "a method runs; the mesh stays as it is until its result comes" });
    else this.order({ kind: "locate", faces, element });
  }

  private fly(slot: Slot, place: Point, size?: number): void {
    find("canvas").dataset["flown"] = place.join(" ");
    this.viewer.fly(slot, place.map((v, axis) => v - this.centre[axis]!) as unknown as Point, size);
  }

  private showQuality(): void {
    const { source, result } = this.figures;
    const columns = {
      source: exact(source, this.session?.source?.quality),
      result: exact(result, this.made && this.resting.at(this.faces)?.quality),
      deviation: this.deviation(),
      unit: this.unit,
    };
    find("table").replaceChildren(qualityTable(columns), spreadTable(columns));
    find("histogram").replaceChildren(stretchHistogram(columns));
  }

  /** Measured at the resolution that the method was asked for alone. */
  private deviation(): Deviation | undefined {
    const { made, at, faces } = this;
    const measured = made?.quality?.deviationMax;
    if (!made || measured === undefined) return undefined;
    return { measured, bound: made.options.value?.maxDeviation, at: at === faces ? undefined : at };
  }

  private showNotes(): void {
    const { session, made } = this;
    const cut = session?.interrupted.filter(() => !this.again && !this.running) ?? [];
    const notes = [
      ...interruptedNotes(cut, (method) => {
        session!.interrupted = session!.interrupted.filter((one) => one !== method);
        this.ask(askedOf(method));
        this.showNotes();
      }),
      ...(made ? this.notesOf(made) : []),
      ...(session?.source && !isManifold(session.source) ? [brokenNote(this.remedies())] : []),
      ...findingList(session?.source?.findings ?? [], (place) => this.fly("source", place)),
    ];
    refill(find("notes"), ...(notes.length > 0 ? notes : [made ? `Nothing to report at ${counted(this.at, "face")}.` : session ? "Nothing to report." : "–"]));
  }

  /** What is amiss at the resolution that is shown, and, where that is another, at the one that the method was asked for. */
  private notesOf(made: Representation): HTMLElement[] {
    const { faces, at } = this;
    const go = (element: Element, where: number): void => this.locate(element, where);
    const asked = resultNotes(made, at, (element) => go(element, at));
    if (faces === at || this.running || faces === 0) return asked;
    const said = this.resting.at(faces);
    const shown = said ? resultNotes(said, faces, (element) => go(element, faces)) : [unknownNote(faces, this.session !== undefined && !this.lost)];
    if (said && shown.length === 0) shown.push(clearNote(said, at));
    return [...shown, ...asked];
  }

  /** Of lengths. */
  private get unit(): string {
    return symbolOf(this.session ? this.session.source?.unit : this.made?.unit);
  }
}
