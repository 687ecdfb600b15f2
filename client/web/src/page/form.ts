import type { JsonObject, JsonValue } from "@bufbuild/protobuf";
import { element, figure } from "./dom";
import { check, clear, pointAt } from "./number_field";
import { labelOf, modelUnits, type Option } from "./schema";

/** Options that most people set; the others are folded away. */
const first = ["subdivisionSize", "tolerance", "maxDeviation", "faces", "subdivisions", "minStretch", "maxSize", "maxValence"];

type Field = HTMLInputElement | HTMLSelectElement;

/** The form of a method, made from the contract. */
export class MethodForm {
  private readonly fields: { option: Option; field: Field }[] = [];
  private readonly standards = new Map<Field, string>();
  private readonly run: HTMLButtonElement;
  /** Where the unit of a length stands. */
  private readonly lengths: HTMLElement[] = [];
  private suggested: Readonly<Record<string, string>> = {};

  constructor(private readonly form: HTMLFormElement, verb: string, options: Option[], start: (body: object) => void) {
    const rows = options.map((option) => this.row(option));
    const shown = rows.filter((_, n) => first.includes(options[n]!.path[0]!));
    const folded = rows.filter((_, n) => !first.includes(options[n]!.path[0]!));
    this.run = element("button", { type: "submit", "aria-disabled": "true" }, verb);
    form.noValidate = true;
    const defaults = element("button", { type: "button", class: "quiet", "aria-label": `Defaults of ${verb}`, click: () => this.reset() }, "Defaults");
    form.append(...shown, element("details", {}, element("summary", {}, "More options"), ...folded), element("div", { class: "row" }, this.run, defaults));
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      if (this.enabled && this.check()) start(this.options());
    });
  }

  /** Sets options that suit a mesh, instead of those that suited the one before. What people set themselves stays. */
  suggest(options: Readonly<Record<string, string>>): void {
    for (const { option, field } of this.fields) {
      const name = option.path.join("."), before = this.suggested[name];
      if (before !== undefined && field.value === before) field.value = "";
      if (options[name] !== undefined) field.value = options[name];
    }
    this.suggested = options;
  }

  /** Another part is open: what was typed for the one before is not for it. */
  begin(): void {
    this.form.reset();
    this.blame(undefined);
  }

  /** Says at fields that are left to their defaults what the last run took for them; undefined: there was none. */
  used(options: JsonObject | undefined): void {
    for (const { option, field } of this.fields) {
      const value = option.path.reduce<JsonValue | undefined>((of, name) => (of as JsonObject | undefined)?.[name], options);
      const words = typeof value === "number" ? `used ${option.kind === "whole" ? value : figure(value)}` : typeof value === "string" ? `default: ${choiceWords(value)}` : undefined;
      if (option.kind === "choice") (field as HTMLSelectElement).options[0]!.text = words ?? "default";
      else if (option.kind !== "flag") (field as HTMLInputElement).placeholder = words ?? this.standards.get(field)!;
    }
  }

  /** Everything as it was at first, and what suits the mesh. */
  private reset(): void {
    this.form.reset();
    this.blame(undefined);
    this.suggest(this.suggested);
    this.form.dispatchEvent(new Event("input", { bubbles: true }));
  }

  /** Of lengths; "" where it is not known. */
  set unit(symbol: string) {
    for (const place of this.lengths) place.textContent = symbol || modelUnits;
  }

  /** The button that runs the method keeps the focus when it cannot be pressed for a while. */
  get enabled(): boolean {
    return this.run.getAttribute("aria-disabled") === "false";
  }

  set enabled(value: boolean) {
    this.run.setAttribute("aria-disabled", String(!value));
  }

  /** Points at the field that the server says is at fault. */
  blame(name: string | undefined): void {
    const path = name?.replace(/^options\./, "").replace(/_([a-z])/g, (_, letter: string) => letter.toUpperCase());
    for (const { option, field } of this.fields) {
      if (option.path.join(".") === path) pointAt(field);
      else clear(field);
    }
  }

  private row(option: Option): HTMLElement {
    const id = `${this.form.id}-${option.path.join("-")}`;
    const field = this.fieldOf(option, id);
    this.fields.push({ option, field });
    const help = element("p", { id: `${id}-help`, class: "help", hidden: true }, option.help);
    const tell = element("button", { type: "button", class: "ask", "aria-expanded": "false", "aria-controls": `${id}-help`, "aria-label": `What ${labelOf(option.path)} means` }, "?");
    tell.addEventListener("click", () => {
      help.hidden = !help.hidden;
      tell.setAttribute("aria-expanded", String(!help.hidden));
    });
    const label = element("label", { for: id }, labelOf(option.path));
    if (option.unit) {
      const unit = element("span", { class: "unit" }, option.unit);
      label.append(" ", unit);
      if (option.unit === modelUnits) this.lengths.push(unit);
    }
    return element("div", { class: "field" }, label, field, tell, help);
  }

  private fieldOf(option: Option, id: string): Field {
    const help = `${id}-help`;
    if (option.kind === "flag") return element("input", { id, type: "checkbox", "aria-describedby": help });
    if (option.kind === "choice") {
      const field = element("select", { id, "aria-describedby": help });
      for (const choice of option.choices) {
        const none = choice.endsWith("UNSPECIFIED");
        field.append(element("option", { value: none ? "" : choice }, none ? "default" : choiceWords(choice)));
      }
      return field;
    }
    const standard = option.standard.length > 26 ? "default" : option.standard;
    const field = element("input", { id, type: "number", step: option.kind === "whole" ? 1 : "any", placeholder: standard || "default", title: option.standard, inputmode: "decimal", "aria-describedby": help });
    this.standards.set(field, field.placeholder);
    return field;
  }

  /** Points at the first field that cannot be sent. */
  private check(): boolean {
    this.blame(undefined);
    return this.fields.every(({ option, field }) => {
      const { kind, path, bounds } = option;
      return kind === "flag" || kind === "choice" || check(field as HTMLInputElement, labelOf(path), kind === "whole" ? bounds : undefined);
    });
  }

  private options(): object {
    const options: Record<string, unknown> = {};
    for (const { option, field } of this.fields) {
      const value = valueOf(option, field);
      if (value === undefined) continue;
      let to = options;
      for (const name of option.path.slice(0, -1)) to = (to[name] ??= {}) as Record<string, unknown>;
      to[option.path.at(-1)!] = value;
    }
    return options;
  }
}

const choiceWords = (choice: string): string => choice.toLowerCase().replace(/_/g, " ");

function valueOf(option: Option, field: Field): unknown {
  if (option.kind === "flag") return (field as HTMLInputElement).checked || undefined;
  if (field.value === "") return undefined;
  return option.kind === "choice" ? field.value : Number(field.value);
}
