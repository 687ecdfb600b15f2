import { isMrrFile } from "../../decoder/src/index";
import { Problem, problemText } from "../shared/problem";
import type { ProblemText } from "../shared/protocol";
import { upload } from "./api";
import { element, find, refill } from "./dom";
import { othersNote, readDrop, type Dropped } from "./drop";
import { check, clear, pointAt } from "./number_field";
import { hideProblem, showProblem } from "./problems";
import { ProgressBar } from "./progress";
import { samples } from "./samples";
import type { Workbench } from "./workbench";

/** Bytes that tell a .vsplit file. */
const markBytes = 8;

type Show = (stage: string, share: number) => void;

/** Whether the name says that a file is of a kind that is read; the kinds stand beside the field. */
function isKnown(name: string): boolean {
  const kinds = find("kinds").textContent.toLowerCase().split(/\W+/);
  return kinds.includes(/\.(\w+)$/.exec(name.toLowerCase())?.[1] ?? "");
}

/** What went wrong with a file, with its name, and what would be accepted where it is of some other kind. */
function aboutFile(name: string, { detail, ...problem }: ProblemText): ProblemText {
  const other = ["UNKNOWN_FORMAT", "MALFORMED_INPUT", "TRUNCATED_INPUT"].includes(problem.cause) && !isKnown(name);
  const kinds = find("kinds").textContent.trim();
  return { ...problem, detail: `${name}: ${other ? `by its name it is no mesh file (accepted: ${kinds}); ` : ""}${detail}` };
}

async function fetchSample(name: string, signal: AbortSignal): Promise<Blob> {
  const response = await fetch(`samples/${name}`, { signal });
  if (!response.ok) throw new Problem({ cause: "NOT_FOUND", detail: `the server has no sample ${name}` });
  return response.blob();
}

/** A mesh that was uploaded here, and the session that it became. */
interface Sent {
  session: string;
  file: Blob;
  name: string;
  sample: string | undefined;
  repair: string;
}

const repairs = ["NONE", "SAFE", "FULL"];

/** Brings meshes in: files that are chosen or dropped, and samples. One that is on its way gives way to the next. */
export class Incoming {
  private coming: AbortController | undefined;
  /** What was sent last, to be sent again with other options; a reload forgets it. */
  private sent: Sent | undefined;
  /** Whether what comes is what is open already, with other options. */
  repeats = false;

  /** `changed`: when something is on its way, or no more. */
  constructor(private readonly bench: Workbench, private readonly changed: () => void) {
    this.startFile();
    this.startDrop();
    this.startSamples();
    find("apply").addEventListener("click", () => this.again());
  }

  /** Whether what is open can be sent again. */
  get canRepeat(): boolean {
    return this.sent !== undefined && this.sent.session === this.bench.id && !this.busy;
  }

  /** Sends what is open again, with the options as they are now. */
  again(): void {
    const { sent } = this;
    if (!sent || !this.canRepeat) return;
    this.repeats = true;
    const send = (signal: AbortSignal, show: Show): Promise<void> => this.send(sent.file, sent.name, sent.sample, signal, show);
    void this.bring(sent.name, send).finally(() => (this.repeats = false));
  }

  /** Buttons that send what is open again with a repair that it has not had; words where it is not here any more. */
  remedies(): Node[] {
    const { sent } = this;
    if (sent?.session !== this.bench.id) return [element("span", {}, "Set Repair to safe or full, then choose the file again.")];
    return repairs.slice(repairs.indexOf(sent!.repair) + 1).map((repair) => {
      const click = (): void => {
        find<HTMLSelectElement>("repair").value = repair;
        this.again();
      };
      return element("button", { type: "button", class: "quiet", click }, `Upload again with repair ${repair.toLowerCase()}`);
    });
  }

  get busy(): boolean {
    return this.coming !== undefined;
  }

  giveUp(): void {
    this.coming?.abort();
    this.coming = undefined;
  }

  private async takeFile(file: File): Promise<void> {
    await this.bring(file.name, async (signal, show) => {
      if (file.size === 0) throw new Problem({ cause: "EMPTY_INPUT", detail: "the file is empty, 0 bytes" });
      if (isMrrFile(new Uint8Array(await file.slice(0, markBytes).arrayBuffer()))) {
        return this.bench.openFile(file, (share) => show("read", share), signal);
      }
      return this.send(file, file.name, undefined, signal, show);
    });
  }

  private async takeSample(name: string): Promise<void> {
    await this.bring(name, async (signal, show) => this.send(await fetchSample(name, signal), name, name, signal, show));
  }

  private async send(file: Blob, name: string, sample: string | undefined, signal: AbortSignal, show: Show): Promise<void> {
    const weld = find<HTMLInputElement>("weld");
    const options = { repair: find<HTMLSelectElement>("repair").value, weld: Number(weld.value), unit: find<HTMLSelectElement>("unit").value };
    const session = await upload(file, options, (share) => show(share < 1 ? "upload" : "inspect", share), signal);
    if (signal.aborted) return;
    this.sent = { session: session.id, file, name, sample, repair: options.repair };
    this.bench.replace(session, name, sample);
  }

  private async bring(name: string, work: (signal: AbortSignal, show: Show) => Promise<void>): Promise<void> {
    const weld = find<HTMLInputElement>("weld");
    clear(weld);
    if (!check(weld, "Weld")) return;
    hideProblem();
    this.giveUp();
    const own = (this.coming = new AbortController());
    this.changed();
    const progress = new ProgressBar(find("upload"), () => find("file"), () => own.abort());
    progress.title = `${name}: `;
    progress.show("upload", 0);
    try {
      await work(own.signal, (stage, share) => progress.show(stage, share));
    } catch (error) {
      if (this.coming !== own) return;
      const problem = problemText(error);
      showProblem(problem.cause === "CANCELLED" ? problem : aboutFile(name, problem));
      if (problem.field === "weld") pointAt(weld);
    } finally {
      progress.hide();
      if (this.coming === own) this.coming = undefined;
      this.changed();
    }
  }

  private startFile(): void {
    const input = find<HTMLInputElement>("file");
    input.addEventListener("change", () => {
      const file = input.files?.[0];
      refill(find("dropped"));
      if (file) void this.takeFile(file);
      input.value = "";
    });
  }

  private startDrop(): void {
    const { body } = document;
    const over = (event: DragEvent): boolean => event.dataTransfer?.types.includes("Files") ?? false;
    body.addEventListener("dragover", (event) => {
      event.preventDefault();
      body.classList.toggle("dragging", over(event));
    });
    body.addEventListener("dragleave", (event) => {
      if (event.relatedTarget === null) body.classList.remove("dragging");
    });
    body.addEventListener("drop", (event) => {
      event.preventDefault();
      body.classList.remove("dragging");
      this.takeDrop(readDrop(event.dataTransfer));
    });
  }

  private takeDrop(dropped: Dropped): void {
    const [first] = dropped.files;
    if (!first) {
      refill(find("dropped"));
      const what = dropped.folders.length > 0 ? `${dropped.folders.join(", ")}: a folder cannot be opened` : "nothing that was dropped is a file";
      return showProblem({ cause: "UNSUPPORTED", detail: `${what}; drop a mesh file (${find("kinds").textContent.trim()})` });
    }
    const take = (file: File): void => {
      refill(find("dropped"), ...othersNote(dropped, file, take));
      void this.takeFile(file);
    };
    take(first);
  }

  private startSamples(): void {
    let coming: string | undefined;
    for (const { name } of samples) {
      const button = element("button", { type: "button", class: "quiet" }, name);
      button.addEventListener("click", (event) => {
        // Two clicks in a row ask once.
        if (event.detail > 1 || coming === name) return;
        coming = name;
        refill(find("dropped"));
        void this.takeSample(name).finally(() => {
          if (coming === name) coming = undefined;
        });
      });
      find("samples").append(button);
    }
  }
}
