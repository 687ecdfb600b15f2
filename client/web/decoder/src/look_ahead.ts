import type { ProgressiveMesh } from "./mesh.js";

/** Vertices at a time. */
const together = 32;
/** Faces around each: as many as most have. */
const turns = 6;

/**
 * Reads the memory around vertices before their turn comes, so that it is in the caches then. A walk around one vertex waits for every
 * step of it; the steps of many walks side by side are waited for together. Beyond the caches that is most of the time.
 */
export class LookAhead {
  private readonly corners = new Int32Array(together);
  private end = 0;
  /** Something must come of what is read, or the compiler leaves it out. */
  strange = 0;

  begin(): void {
    this.end = 0;
  }

  /** The turn of the n-th vertex has come; those that are not there yet, or negative numbers, are left out. O(1) on the average. */
  reach(n: number, mesh: ProgressiveMesh, vertices: Int32Array, count: number): void {
    if (n < this.end) return;
    this.end = Math.min(n + together, count);
    this.walk(this.setOut(n, mesh, vertices), mesh);
  }

  private setOut(from: number, { cornerOf, vertexCount }: ProgressiveMesh, vertices: Int32Array): number {
    const { corners, end } = this;
    let walkers = 0;
    for (let n = from; n < end; ++n) {
      const vertex = vertices[n]! | 0;
      if (vertex >= 0 && vertex < vertexCount) corners[walkers++] = cornerOf[vertex]!;
    }
    return walkers;
  }

  private walk(walkers: number, { around, positions }: ProgressiveMesh): void {
    const { corners } = this;
    for (let turn = 0; turn < turns; ++turn) {
      for (let n = 0; n < walkers; ++n) {
        const corner = corners[n]! | 0;
        if (positions[3 * around[2 * corner]!] === Infinity) ++this.strange;
        corners[n] = around[2 * corner + 1]!;
      }
    }
  }
}
