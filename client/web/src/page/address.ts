/** What the address keeps, so that a reload finds it again. */
export interface Place {
  session?: string;
  representation?: string;
  faces?: number;
  name?: string;
  /** Which of the samples it is. */
  sample?: string;
}

/** The address as it was read or written last. */
let known = location.hash;

export function readPlace(): Place {
  known = location.hash;
  const said = new URLSearchParams(location.hash.slice(1));
  return {
    session: said.get("session") ?? undefined,
    representation: said.get("representation") ?? undefined,
    faces: /^[1-9]\d{0,9}$/.test(said.get("faces") ?? "") ? Number(said.get("faces")) : undefined,
    name: said.get("name") ?? undefined,
    sample: said.get("sample") ?? undefined,
  };
}

/** Does nothing where the address was changed otherwise, and nobody has read it since. */
export function writePlace(place: Place): void {
  if (location.hash !== known) return;
  const said = new URLSearchParams();
  for (const [name, value] of Object.entries(place)) if (value !== undefined) said.set(name, String(value));
  history.replaceState(null, "", said.size > 0 ? `#${said}` : location.pathname);
  known = location.hash;
}
