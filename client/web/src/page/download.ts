import { fields } from "../shared/access";
import { problemOf } from "../shared/problem";
import { element } from "./dom";

const nameIn = /filename="([^"]*)"/;

/** A link can carry no token, and would leave the page where the server refuses: the file is fetched and handed over, named `stem`, with
 * the ending that the server gives it. */
export async function fetchFile(path: string, stem: string): Promise<void> {
  const response = await fetch(path, { headers: fields() });
  if (!response.ok) throw await problemOf(response);
  const ending = /\.\w+$/.exec(nameIn.exec(response.headers.get("content-disposition") ?? "")?.[1] ?? "")?.[0] ?? "";
  const url = URL.createObjectURL(await response.blob());
  element("a", { href: url, download: stem + ending }).click();
  setTimeout(() => URL.revokeObjectURL(url), 60_000);
}
