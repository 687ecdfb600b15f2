import type { Order } from "../shared/protocol";

/** Orders of which the last one counts, and none before. */
const lastCounts: Partial<Record<Order["kind"], string>> = { faces: "resolution", locate: "resolution", colour: "colour" };

/** Orders that wait while another is carried out, oldest first. */
export class Orders {
  private waiting: Order[] = [];

  /** Returns how many orders are dropped since `order` makes them stale. */
  push(order: Order): number {
    const before = this.waiting.length;
    const group = lastCounts[order.kind];
    if (group !== undefined) this.waiting = this.waiting.filter(({ kind }) => lastCounts[kind] !== group);
    const dropped = before - this.waiting.length;
    this.waiting.push(order);
    return dropped;
  }

  take(): Order | undefined {
    return this.waiting.shift();
  }

  get empty(): boolean {
    return this.waiting.length === 0;
  }
}
