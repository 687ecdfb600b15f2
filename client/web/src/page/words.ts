/** Words of the server that name its calls, and what they mean to somebody who sees a page. */
const calls: readonly [RegExp, string][] = [
  [/[;,] it may have been deleted or have expired, and CreateSession makes a new one/, "; it may have been deleted or have expired. Upload the mesh again"],
  [/; UploadMesh gives it one/, "; upload one"],
];

/** A problem's words as they fit a page. */
export const onPage = (detail: string): string => calls.reduce((words, [of, instead]) => words.replace(of, instead), detail);

/** What the contract says beside the option itself: symbols of the paper, other documents and how it is over the wire. */
const asides: readonly RegExp[] = [
  /^(sigma_[A-Z]+|tau_[A-Z]+|w_e): /,
  /:? tau_TL of the paper is tolerance\^2, so tau_TL = [\d.]+ is a tolerance of \d+\.\d+/,
  / \(docs\/[^)]*\)/g,
  / \(what this method works on: source of the request\)/g,
  / Left out of Representation\./g,
  /: faces_min of the Representation says where that is/g,
];

/** An option's description as help: without asides, options named as their fields are. Sentences start with a capital. */
export function helpWords(description: string): string {
  const said = asides.reduce((words, aside) => words.replace(aside, ""), description);
  const named = said.replace(/\b[a-z]+(?:_[a-z]+)+\b/g, (name) => name.replace(/_/g, " ")).replace(/\b(STRICT|EXTENDED|DIHEDRAL|NORMAL_VOTING)\b/g, (name) => name.toLowerCase().replace(/_/g, " "));
  return named.replace(/(^|\. )[a-z]/g, (begun) => begun.toUpperCase());
}
