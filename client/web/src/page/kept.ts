export type Verb = "improve" | "control";

/** A method as the server is asked for it. */
export interface Asked {
  verb: Verb;
  body: object;
}

/** What a tab remembers of a session beyond what its address says: it outlives a reload, and goes with the tab. */
export interface Kept {
  /** What was typed and chosen, by ids of fields. */
  fields?: Record<string, string>;
  /** The method that runs. */
  method?: Asked;
}

const keyOf = (session: string): string => `vsplit session ${session}`;

/** `session`: "" before there is one. */
export function keptOf(session: string): Kept {
  try {
    return JSON.parse(sessionStorage.getItem(keyOf(session)) ?? "{}") as Kept;
  } catch {
    return {}; // no storage here, or not ours
  }
}

/** In place of what was kept under the same names; undefined is nothing. */
export function keep(session: string, what: Kept): void {
  try {
    sessionStorage.setItem(keyOf(session), JSON.stringify({ ...keptOf(session), ...what }));
  } catch {
    // no storage here, or full: a reload then begins anew
  }
}

export function forget(session: string): void {
  sessionStorage.removeItem(keyOf(session));
}
