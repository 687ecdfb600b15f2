import type { ProblemText } from "./protocol";

/** What a server refused, or what went wrong on this side. */
export class Problem extends Error {
  constructor(readonly text: ProblemText) {
    super(text.detail);
  }
}

export function fail(detail: string): Problem {
  return new Problem({ cause: "INTERNAL", detail });
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
