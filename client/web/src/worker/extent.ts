import type { Range } from "../shared/colours";

/** The least above 0 and the largest of numbers. */
export class Extent {
  private least = Infinity;
  private largest = 0;

  add(value: number): void {
    if (value > 0 && value < this.least) this.least = value;
    if (value > this.largest) this.largest = value;
  }

  get range(): Range {
    return [this.least, this.largest];
  }
}
