import { keepAlive } from "./api";
import type { Session } from "../gen/vsplit/v1/meshing_pb";

/** Milliseconds to wait before the end of a session is put off again: a third of what it has, but a second at least and, since the
 * two clocks may differ, a minute at most. */
export function pause(session: Session, now: number): number {
  const end = session.expireTime ? Number(session.expireTime.seconds) * 1000 : now;
  return Math.min(60_000, Math.max(1000, (end - now) / 3));
}

/** Keeps the session that is open from expiring for as long as the page is open. */
export class KeepAlive {
  private timer: ReturnType<typeof setTimeout> | undefined;

  /** `lost` is told why where the session is gone all the same. */
  constructor(private readonly lost: (problem: unknown) => void) {}

  watch(session: Session): void {
    this.end();
    this.timer = setTimeout(() => void this.call(session), pause(session, Date.now()));
  }

  end(): void {
    clearTimeout(this.timer);
    this.timer = undefined;
  }

  private async call(session: Session): Promise<void> {
    const mine = this.timer;
    try {
      const kept = await keepAlive(session.id);
      if (this.timer === mine) this.watch(kept); // else another was opened meanwhile
    } catch (problem) {
      if (this.timer === mine) this.lost(problem);
    }
  }
}
