import type { MeshSummary } from "../gen/vsplit/v1/meshing_pb";
import { count } from "./dom";

/** What an uploaded mesh is, in a line; lengths are in `unit`, empty where it is not known. */
export function summaryOf(source: MeshSummary, unit: string): string {
  const kind = source.closed ? `closed, genus ${source.genus}` : `${count(source.boundaryEdges)} boundary edges`;
  const pieces = source.components === 1 ? "1 piece" : `${count(source.components)} pieces`;
  return `${count(source.faces)} faces, ${count(source.vertices)} vertices; ${pieces}, ${kind}${unit ? `; lengths in ${unit}` : ""}.`;
}

/** Of a file that no server has. */
export function fileSummary(facesMin: number, facesMax: number, unit: string): string {
  const levels = `${count(facesMin)} to ${count(facesMax)} faces${unit ? `; lengths in ${unit}` : ""}`;
  return `A .vsplit file, opened here alone: ${levels}. All its resolutions are at hand; methods and downloads are for meshes that are uploaded.`;
}
