import { fields } from "../shared/access";
import { problemOf } from "../shared/problem";
import { element } from "./dom";

const nameIn = /filename="([^"]*)"/;

/** A link can carry no token, and would leave the page where the server refuses: the file is fetched and handed over. */
export async function fetchFile(path: string): Promise<void> {
  const response = await fetch(path, { headers: fields() });
  if (!response.ok) throw await problemOf(response);
  const url = URL.createObjectURL(await response.blob());
  element("a", { href: url, download: nameIn.exec(response.headers.get("content-disposition") ?? "")?.[1] ?? "mesh" }).click();
  setTimeout(() => URL.revokeObjectURL(url), 60_000);
}
