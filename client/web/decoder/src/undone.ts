import type { Kind } from "./mesh.js";

const doubles = 6;

/** Records that were undone, the last one undone first to be had back. Arrays only: objects a record would cost many times as much. */
export class UndoneRecords {
  count = 0;
  private kinds = new Uint8Array(1024);
  private numbers = new Uint32Array(2 * 1024);
  private places = new Float64Array(doubles * 1024);

  /** `a` and `b`: anchor and steps of a split, half-edge of a flip, vertex of a move. */
  push(kind: Kind, a: number, b: number, x: number, y: number, z: number, x2 = 0, y2 = 0, z2 = 0): void {
    if (this.count === this.kinds.length) this.grow();
    const n = this.count++;
    this.kinds[n] = kind;
    this.numbers[2 * n] = a;
    this.numbers[2 * n + 1] = b;
    this.places.set([x, y, z, x2, y2, z2], doubles * n);
  }

  kind(): Kind {
    return this.kinds[this.count - 1]!;
  }

  /** `which`: 0 or 1. */
  number(which: number): number {
    return this.numbers[2 * (this.count - 1) + which]!;
  }

  /** `which`: 0 to 5. */
  place(which: number): number {
    return this.places[doubles * (this.count - 1) + which]!;
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
    const places = new Float64Array(doubles * size);
    places.set(this.places);
    this.places = places;
  }
}
