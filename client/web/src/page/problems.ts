import type { ProblemText } from "../shared/protocol";
import { element, find } from "./dom";
import { askForToken } from "./token";

/** Shows what went wrong until it is closed or something else goes wrong. */
export function showProblem({ cause, detail, field, retryAfter }: ProblemText): void {
  if (cause === "UNAUTHENTICATED") askForToken();
  const close = element("button", { type: "button", class: "quiet", "aria-label": "Close" }, "×");
  const words = element("p", {}, element("strong", {}, cause), ` ${detail}`);
  if (field) words.append(element("span", { class: "hint" }, ` (${field})`));
  if (retryAfter) words.append(element("span", { class: "hint" }, ` Try again in ${retryAfter} s.`));
  close.addEventListener("click", hideProblem);
  find("problems").replaceChildren(words, close);
}

export function hideProblem(): void {
  find("problems").replaceChildren();
}
