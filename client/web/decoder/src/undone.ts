import type { Kind } from "./mesh.js";

const doubles = 6;

/** Records that were undone, the last one undone first to be had back. Arrays only: objects a record would cost many times as much. */
export class UndoneRecords {
  count = 0;
  private kinds = new Uint8Array(1024);
  private numbers = new Uint32Array(2 * 1024);
  private doubles = new Float64Array(doubles * 1024);
  private readonly last = new Float64Array(doubles);

  /** `a` and `b`: anchor and steps of a split, half-edge of a flip, vertex of a move. */
  push(kind: Kind, a: number, b: number): void {
    if (this.count === this.kinds.length) this.grow();
    const n = this.count++;
    this.kinds[n] = kind;
    this.numbers[2 * n] = a;
    this.numbers[2 * n + 1] = b;
  }

  /** Where the record that was pushed last put a vertex; `which`: 0, or 1 for the new one of a split. */
  keepPlace(which: number, positions: Float64Array, vertex: number): void {
    const to = doubles * (this.count - 1) + 3 * which;
    for (let axis = 0; axis < 3; ++axis) this.doubles[to + axis] = positions[3 * vertex + axis]!;
  }

  kind(): Kind {
    return this.kinds[this.count - 1]!;
  }

  /** `which`: 0 or 1. */
  number(which: number): number {
    return this.numbers[2 * (this.count - 1) + which]!;
  }

  /** Both places, until it is asked again. */
  places(): Float64Array {
    const from = doubles * (this.count - 1);
    for (let n = 0; n < doubles; ++n) this.last[n] = this.doubles[from + n]!;
    return this.last;
  }

  pop(): void {
    --this.count;
  }

  private grow(): void {
    const size = 2 * this.kinds.length;
    const kinds = new Uint8Array(size);
    kinds.set(this.kinds);
    this.kinds = kinds;
    const numbers = new Uint32Array(2 * size);
    numbers.set(this.numbers);
    this.numbers = numbers;
    const larger = new Float64Array(doubles * size);
    larger.set(this.doubles);
    this.doubles = larger;
  }
}
