import { helpWords } from "./words";

/** A field of a form: an option of a method as the contract describes it. */
export interface Option {
  /** Path in the request, e.g. ["sizing", "chordError"]. */
  path: string[];
  kind: "number" | "whole" | "flag" | "choice";
  choices: string[];
  help: string;
  /** What is taken where nothing is said, in the contract's words. */
  standard: string;
  /** "°", modelUnits, or nothing. */
  unit: string;
  /** Bounds of a whole number's type. */
  bounds: readonly [least: number, most: number];
}

/** Of a length whose mesh does not say it. */
export const modelUnits = "units";

interface Schema {
  type?: string;
  $ref?: string;
  description?: string;
  enum?: string[];
  minimum?: number;
  maximum?: number;
  properties?: Record<string, Schema>;
}

export interface Contract {
  components: { schemas: Record<string, Schema> };
}

const lengths = /(size|tolerance|deviation|error|field)$/i;

function unitOf(name: string, description: string): string {
  if (/degrees/i.test(description) || /angle$/i.test(name)) return "°";
  return lengths.test(name) ? modelUnits : "";
}

function standardOf(description: string): string {
  const said = /default:?\s+([^.;(]*(?:\.\d[^.;(]*)*)/i.exec(description)?.[1]?.trim();
  return said ? said.replace(/\s+/g, " ") : "";
}

const plain = (text: string): string => text.replace(/`/g, "").replace(/\s+/g, " ").trim();

function optionsOf(contract: Contract, message: string, before: string[]): Option[] {
  const { schemas } = contract.components;
  const twin = schemas[message === "ControlOptions" ? "ImproveOptions" : message]?.properties ?? {};
  const options: Option[] = [];
  for (const [name, schema] of Object.entries(schemas[message]?.properties ?? {})) {
    const said = schema.description ?? "";
    const description = plain(said.startsWith("As in ImproveOptions") ? (twin[name]?.description ?? said) : said);
    const target = schema.$ref?.split("/").at(-1) ?? "";
    const path = [...before, name];
    const base = { path, help: helpWords(description), standard: standardOf(description), unit: unitOf(name, description), choices: [], bounds: [schema.minimum ?? 0, schema.maximum ?? Number.MAX_SAFE_INTEGER] as const };
    if (target === "Double") options.push({ ...base, kind: "number" });
    else if (schema.type === "integer") options.push({ ...base, kind: "whole" });
    else if (schema.type === "boolean") options.push({ ...base, kind: "flag" });
    else if (schemas[target]?.enum) options.push({ ...base, kind: "choice", choices: schemas[target]!.enum! });
    else if (target === "Sizing") options.push(...optionsOf(contract, target, path));
  }
  return options;
}

/** The options of a method that a form can ask for: no lists. `message` is e.g. "ImproveOptions". */
export function methodOptions(contract: Contract, message: string): Option[] {
  return optionsOf(contract, message, []);
}

/** "minMeanStretch" as words. */
export function labelOf(path: string[]): string {
  const words = path.join(" ").replace(/([a-z])([A-Z])/g, "$1 $2").toLowerCase();
  return words.charAt(0).toUpperCase() + words.slice(1);
}

/** A format as people write it. */
export const formatLabel = (name: string): string => (name === "THREE_MF" ? "3mf" : name.toLowerCase().replace(/_/g, " "));

/** Formats to download: those that have a name. */
export function formatsOf(contract: Contract): string[] {
  return (contract.components.schemas["MeshFormat"]?.enum ?? []).filter((name) => !name.endsWith("UNSPECIFIED"));
}
