import { keep, keptOf } from "./kept";

type Field = HTMLInputElement | HTMLSelectElement;

const isTick = (field: Field): field is HTMLInputElement => field.type === "checkbox";

/** What is typed and chosen in the fields of a place comes back after a reload, session by session. */
export class KeptFields {
  /** Whose fields these are; "" before there is a session. */
  session = "";

  constructor(private readonly place: HTMLElement) {
    for (const kind of ["input", "change"]) place.addEventListener(kind, () => this.keep());
  }

  /** `session` is open now ("" for none): its fields come back; where it has none yet, those that are there become its own. */
  open(session: string): void {
    this.session = session;
    const { fields } = keptOf(session);
    if (!fields) return this.keep();
    for (const field of this.fields()) {
      const value = fields[field.id];
      if (value === undefined) continue;
      if (isTick(field)) field.checked = value !== "";
      else field.value = value;
      // An option that counts is seen.
      if (value !== "") field.closest("details")?.setAttribute("open", "");
    }
  }

  private keep(): void {
    keep(this.session, { fields: Object.fromEntries(this.fields().map((field) => [field.id, isTick(field) ? (field.checked ? "on" : "") : field.value])) });
  }

  private fields(): Field[] {
    return [...this.place.querySelectorAll<Field>("input:not([type=file]), select")].filter(({ id }) => id !== "");
  }
}
