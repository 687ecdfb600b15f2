import { count, element, find, passFocus } from "./dom";

const stages: Record<string, string> = {
  upload: "Uploading",
  read: "Reading the file",
  queued: "Waiting for its turn",
  inspect: "Inspecting",
  subdivide: "Subdividing",
  evaluate: "Evaluating edges",
  simplify: "Simplifying",
  measure: "Measuring the deviation",
};

/** For those who listen, each stage once: not every number on the way. */
function say(words: string): void {
  const place = find("spoken");
  if (place.textContent !== words) place.textContent = words;
}

/** A bar with what is done, and a button that ends it. `next`: where the focus goes with that button gone. */
export class ProgressBar {
  private readonly bar = element("progress", { max: 1, value: 0, "aria-label": "Progress" });
  private readonly words = element("span");
  private readonly box: HTMLElement;
  /** Of what it is the progress. */
  title = "";

  constructor(private readonly place: HTMLElement, private readonly next: () => HTMLElement, cancel: () => void) {
    const button = element("button", { type: "button", class: "quiet" }, "Cancel");
    button.addEventListener("click", cancel);
    this.box = element("div", { class: "progress" }, this.words, this.bar, button);
  }

  show(stage: string, fraction: number, faces = 0): void {
    const words = this.title + (stages[stage] ?? stage);
    this.words.textContent = words + (faces > 0 ? `, ${count(faces)} faces` : "");
    say(words);
    this.bar.value = fraction;
    if (!this.box.isConnected) this.place.append(this.box);
  }

  hide(): void {
    if (this.box.isConnected) say(`${this.title}ended`);
    passFocus(this.box, this.next());
    this.box.remove();
  }
}

export const workPlace = (): HTMLElement => find("work");
