import { joined, nothing, rangeOf, type ColourBy, type Range } from "../shared/colours";
import type { Patch } from "../shared/protocol";
import type { Slot, View } from "./viewer";

/**
 * What meshes are coloured by. Side by side they share one range, so that a colour means the same in either; it is widened as soon
 * as a face beyond it is drawn.
 */
export class Colouring {
  by: ColourBy = "stretch";
  range: Range = rangeOf("stretch", nothing);
  private view: View = "both";
  private sizes: Record<Slot, Range> = { source: nothing, result: nothing };

  /** `changed`: when meshes are to be coloured anew. */
  constructor(private readonly changed: () => void) {}

  choose(by: ColourBy): void {
    this.by = by;
    this.update(true);
  }

  show(view: View): void {
    this.view = view;
    this.update(false);
  }

  /** A patch is drawn: instead of what was there, or beside it. */
  take(slot: Slot, { slots, positions, sizes }: Patch): void {
    const whole = positions.length === 9 * slots;
    this.measured(slot, whole ? sizes : joined(this.sizes[slot], sizes));
  }

  /** These are the sizes of all faces of a mesh. */
  measured(slot: Slot, sizes: Range): void {
    this.sizes[slot] = sizes;
    this.update(false);
  }

  /** Nothing is drawn. */
  clear(): void {
    this.sizes = { source: nothing, result: nothing };
    this.update(true);
  }

  private update(anyway: boolean): void {
    const { source, result } = this.sizes;
    const range = rangeOf(this.by, this.view === "both" ? joined(source, result) : this.sizes[this.view]);
    if (!anyway && range[0] === this.range[0] && range[1] === this.range[1]) return;
    this.range = range;
    this.changed();
  }
}
