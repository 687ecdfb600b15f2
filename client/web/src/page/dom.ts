type Child = Node | string | undefined;
type Attributes = Record<string, string | number | boolean | EventListener | undefined>;

/** An element with attributes (functions listen, `true` is an empty one, `false` and undefined none) and children. */
export function element<Tag extends keyof HTMLElementTagNameMap>(tag: Tag, attributes: Attributes = {}, ...children: Child[]): HTMLElementTagNameMap[Tag] {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === "function") made.addEventListener(name, value);
    else if (value !== undefined && value !== false) made.setAttribute(name, value === true ? "" : String(value));
  }
  made.append(...children.filter((child) => child !== undefined));
  return made;
}

/** One that the page has. */
export function find<Kind extends HTMLElement>(id: string): Kind {
  const found = document.getElementById(id);
  if (!found) throw new Error(`the page has no #${id}`);
  return found as Kind;
}

/** Moves the focus where it would be lost with `gone`, that is to be hidden, disabled or taken out. */
export function passFocus(gone: HTMLElement, next: HTMLElement): void {
  if (gone.contains(document.activeElement)) next.focus({ preventScroll: true });
}

/** Gives a place other children. A focus on one of its buttons goes to the one that is there now. */
export function refill(place: HTMLElement, ...children: (Node | string)[]): void {
  const buttons = (): HTMLElement[] => [...place.querySelectorAll("button")];
  const at = buttons().indexOf(document.activeElement as HTMLElement);
  place.replaceChildren(...children);
  if (at >= 0) (buttons()[at] ?? buttons().at(-1) ?? find("canvas")).focus({ preventScroll: true });
}

const whole = new Intl.NumberFormat("en");
export const count = (value: number): string => whole.format(value);
/** "1 face", "2 faces". */
export const counted = (value: number, one: string, many = `${one}s`): string => `${count(value)} ${value === 1 ? one : many}`;
export const figure = (value: number, digits = 4): string => (Number.isFinite(value) ? String(Number(value.toPrecision(digits))) : "none");
