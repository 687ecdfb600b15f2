import type { ProblemText } from "../shared/protocol";
import { element, find, passFocus, refill } from "./dom";
import { askForToken } from "./token";
import { onPage } from "./words";

let before: HTMLElement | undefined;

/** Closing what went wrong leads back to where the focus came from. */
export function startProblems(): void {
  find("problems").addEventListener("focusin", ({ relatedTarget }) => {
    if (relatedTarget instanceof HTMLElement && !find("problems").contains(relatedTarget)) before = relatedTarget;
  });
}

/** Shows what went wrong until it is closed or something else goes wrong. `remedies`: what can be done about it. */
export function showProblem({ cause, detail, field, retryAfter }: ProblemText, ...remedies: Node[]): void {
  if (cause === "UNAUTHENTICATED" || cause === "FORBIDDEN") askForToken();
  const close = element("button", { type: "button", class: "quiet", "aria-label": "Close" }, "×");
  const words = element("p", {}, element("strong", {}, cause), ` ${onPage(detail)}`);
  if (field) words.append(element("span", { class: "hint" }, ` (${field})`));
  if (retryAfter) words.append(element("span", { class: "hint" }, ` Try again in ${retryAfter} s.`));
  if (remedies.length > 0) words.append(element("span", { class: "links" }, ...remedies));
  // What people end themselves is no fault.
  find("problems").classList.toggle("calm", cause === "CANCELLED");
  close.addEventListener("click", hideProblem);
  refill(find("problems"), words, close);
}

export function hideProblem(): void {
  const place = find("problems");
  passFocus(place, before?.isConnected ? before : find("canvas"));
  place.replaceChildren();
}
