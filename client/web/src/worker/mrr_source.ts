import { CorruptError, MrrFile, MrrFileError } from "../../decoder/src/index";
import { Problem } from "../shared/problem";
import type { Point } from "../shared/protocol";
import { HeldMesh } from "./held_mesh";

/** Milliseconds of reading before others have their turn. */
const turn = 60;

/** The mesh of a .vsplit file at the level it was made for. `read` is told how far it is, and may throw. Throws Problem. */
export async function readMrr(file: Blob, read: (share: number) => Promise<void>): Promise<{ held: HeldMesh; description: unknown }> {
  try {
    const source = new MrrFile(new Uint8Array(await file.arrayBuffer()));
    const held = new HeldMesh(source.base, source.grid, source.splits);
    let due = performance.now() + turn;
    for (const block of source.blocks()) {
      held.take(block);
      if (performance.now() < due) continue;
      await read(held.recordsHeld / source.records);
      due = performance.now() + turn;
    }
    source.checkLevel(held.mesh.level);
    held.show(source.shown);
    return { held, description: parsed(source.description) };
  } catch (error) {
    if (error instanceof MrrFileError) throw new Problem({ cause: error.fault, detail: error.message });
    if (error instanceof CorruptError) throw new Problem({ cause: "CORRUPT", detail: error.message });
    throw error;
  }
}

/** Whoever wrote a file may have said nothing about it, or what is no JSON. */
function parsed(text: string): unknown {
  try {
    return JSON.parse(text) as unknown;
  } catch {
    return {};
  }
}

/** The middle of the box around a mesh as it is shown, and half the box. */
export function boxOf({ mesh }: HeldMesh): { centre: Point; half: Point } {
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  for (let n = 3 * mesh.ghosts; n < 3 * mesh.vertexCount; ++n) {
    const axis = n % 3, value = mesh.positions[n]!;
    if (value < low[axis]!) low[axis] = value;
    if (value > high[axis]!) high[axis] = value;
  }
  const of = (value: (axis: number) => number): Point => [value(0), value(1), value(2)];
  return { centre: of((axis) => (low[axis]! + high[axis]!) / 2), half: of((axis) => (high[axis]! - low[axis]!) / 2) };
}
