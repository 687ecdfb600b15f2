import type { MeshSummary } from "../gen/vsplit/v1/meshing_pb";
import { withUnit } from "../shared/units";
import { counted, figure } from "./dom";

/** What an uploaded mesh is, in a line; lengths are in `unit`, empty where it is not known. */
export function summaryOf(source: MeshSummary, unit: string): string {
  const bounds = counted(source.boundaryEdges, "boundary edge");
  const kind = source.closed ? `closed, genus ${source.genus}` : isManifold(source) ? bounds : `not a manifold, ${bounds}`;
  return `${counted(source.faces, "face")}, ${counted(source.vertices, "vertex", "vertices")}; ${counted(source.components, "piece")}, ${kind}; ${sizeOf(source, unit)}.`;
}

/** Without a boundary, and still not closed, it has edges or vertices of more than one sheet. */
export function isManifold({ closed, boundaryEdges, findings }: MeshSummary): boolean {
  return closed || (boundaryEdges > 0 && !findings.some(({ kind }) => kind.startsWith("NON_MANIFOLD")));
}

/** "120 × 80 × 40 mm": the box around it. */
function sizeOf({ boundingBox }: MeshSummary, unit: string): string {
  const { min, max } = boundingBox!;
  const edges = (["x", "y", "z"] as const).map((axis) => figure(max![axis] - min![axis]));
  return withUnit(edges.join(" × "), unit || "units");
}

/** Of a file that no server has. */
export function fileSummary(facesMin: number, facesMax: number, unit: string): string {
  const levels = `${counted(facesMin, "face")} to ${counted(facesMax, "face")}${unit ? `; lengths in ${unit}` : ""}`;
  return `A .vsplit file, opened here alone: ${levels}. All its resolutions are at hand; methods and downloads are for meshes that are uploaded.`;
}
