import { element } from "./dom";

/** What was dropped, told apart. */
export interface Dropped {
  files: File[];
  /** Names of folders. */
  folders: string[];
}

export function readDrop(data: DataTransfer | null): Dropped {
  const dropped: Dropped = { files: [], folders: [] };
  for (const item of data?.items ?? []) {
    if (item.kind !== "file") continue;
    const file = item.getAsFile();
    if (item.webkitGetAsEntry()?.isDirectory) dropped.folders.push(file?.name ?? "a folder");
    else if (file) dropped.files.push(file);
  }
  return dropped;
}

/** Shown where more was dropped than can be opened: what was taken, and the others, each a button that takes it instead. */
export function othersNote({ files, folders }: Dropped, taken: File, take: (file: File) => void): (Node | string)[] {
  const others = files.filter((file) => file !== taken);
  const words: (Node | string)[] = [];
  if (others.length > 0) {
    words.push(`${taken.name} was taken. Dropped with it: `);
    for (const file of others) words.push(element("button", { type: "button", class: "quiet", "aria-label": `Open ${file.name} instead`, click: () => take(file) }, file.name), " ");
  }
  if (folders.length > 0) words.push(`Not taken, since ${folders.length > 1 ? "they are folders" : "it is a folder"}: ${folders.join(", ")}.`);
  return words;
}
