import { showProblem } from "./problems";

/** Least and most of a whole number's type, as the contract has it; what else is accepted the server knows. */
export type Whole = readonly [least: number, most: number];

/** Why a field's content is not sent, in words; undefined where it may be, or is empty. `unreadable`: no number at all. */
export function refusal(value: string, unreadable: boolean, whole?: Whole): string | undefined {
  const accepted = whole ? `a whole number from ${whole[0]} to ${whole[1]}` : "a number, such as 0.5 or 2e-3";
  if (unreadable) return `this is no number; accepted is ${accepted}`;
  const number = Number(value);
  const good = whole ? Number.isInteger(number) && number >= whole[0] && number <= whole[1] : Number.isFinite(number);
  return good || value === "" ? undefined : `${value} is not accepted; accepted is ${accepted}`;
}

/** Whether a field's content may be sent; where not, says why and points at it. */
export function check(field: HTMLInputElement, name: string, whole?: Whole): boolean {
  const words = refusal(field.value, field.validity.badInput, whole);
  if (words === undefined) return true;
  showProblem({ cause: "INVALID_OPTION", detail: `${name}: ${words}` });
  pointAt(field);
  return false;
}

/** Shows the field that a problem is about, until it is changed. */
export function pointAt(field: HTMLElement): void {
  field.setAttribute("aria-invalid", "true");
  field.setAttribute("aria-errormessage", "problems");
  field.closest("details")?.setAttribute("open", "");
  field.focus();
  field.addEventListener("input", () => clear(field), { once: true });
}

export function clear(field: HTMLElement): void {
  field.removeAttribute("aria-invalid");
  field.removeAttribute("aria-errormessage");
}
