import { Problem } from "../shared/problem";
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

export function problemText(error: unknown): ProblemText {
  if (error instanceof Problem) return error.text;
  if (error instanceof DOMException && error.name === "AbortError") return { cause: "CANCELLED", detail: "cancelled" };
  return { cause: "UNAVAILABLE", detail: error instanceof TypeError ? "the server cannot be reached" : String(error) };
}
