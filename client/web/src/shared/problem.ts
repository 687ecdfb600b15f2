import type { ProblemText } from "./protocol";

/** What a server refused, or what went wrong on this side. */
export class Problem extends Error {
  constructor(readonly text: ProblemText) {
    super(text.detail);
  }
}

export const unreachable = new Problem({ cause: "UNAVAILABLE", detail: "the server cannot be reached" });

export function fail(detail: string): Problem {
  return new Problem({ cause: "INTERNAL", detail });
}

/** From whatever was thrown: fetch throws a TypeError where it gets no answer. */
export function problemText(error: unknown): ProblemText {
  if (error instanceof Problem) return error.text;
  if (error instanceof DOMException && error.name === "AbortError") return { cause: "CANCELLED", detail: "cancelled" };
  if (error instanceof TypeError && /fetch|network/i.test(error.message)) return unreachable.text;
  return fail(String(error)).text;
}

/** From what the server answered: problem+json, or else its status. */
export function problemFrom(status: number, body: string): Problem {
  try {
    const said = JSON.parse(body) as Partial<ProblemText>;
    if (said.cause && said.detail) return new Problem({ cause: said.cause, detail: said.detail, field: said.field, retryAfter: said.retryAfter });
  } catch {
    // not JSON: below
  }
  return new Problem({ cause: "UNAVAILABLE", detail: `the server answered with status ${status}` });
}

export async function problemOf(response: Response): Promise<Problem> {
  return problemFrom(response.status, await response.text());
}
