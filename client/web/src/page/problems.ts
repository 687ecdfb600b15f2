import type { ProblemText } from "../shared/protocol";
import { element, find, passFocus, refill } from "./dom";
import { askForToken } from "./token";

let before: HTMLElement | undefined;

/** Closing what went wrong leads back to where the focus came from. */
export function startProblems(): void {
  find("problems").addEventListener("focusin", ({ relatedTarget }) => {
    if (relatedTarget instanceof HTMLElement && !find("problems").contains(relatedTarget)) before = relatedTarget;
  });
}

/** Shows what went wrong until it is closed or something else goes wrong. */
export function showProblem({ cause, detail, field, retryAfter }: ProblemText): void {
  if (cause === "UNAUTHENTICATED" || cause === "FORBIDDEN") askForToken();
  const close = element("button", { type: "button", class: "quiet", "aria-label": "Close" }, "×");
  const words = element("p", {}, element("strong", {}, cause), ` ${detail}`);
  if (field) words.append(element("span", { class: "hint" }, ` (${field})`));
  if (retryAfter) words.append(element("span", { class: "hint" }, ` Try again in ${retryAfter} s.`));
  close.addEventListener("click", hideProblem);
  refill(find("problems"), words, close);
}

export function hideProblem(): void {
  const place = find("problems");
  passFocus(place, before?.isConnected ? before : find("canvas"));
  place.replaceChildren();
}
