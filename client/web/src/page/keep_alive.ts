import { keepAlive } from "./api";
import type { Session } from "../gen/vsplit/v1/meshing_pb";
import { problemText } from "../shared/problem";
import type { ProblemText } from "../shared/protocol";

/** Milliseconds to wait before the end of a session is put off again: a third of what it has, but a second at least and, since the
 * two clocks may differ, a minute at most. */
export function pause(session: Session, now: number): number {
  const end = session.expireTime ? Number(session.expireTime.seconds) * 1000 : now;
  return Math.min(60_000, Math.max(1000, (end - now) / 3));
}

/** What a server may answer while the session is still there: it is asked again. */
const passing = ["UNAVAILABLE", "LIMIT_EXCEEDED", "DEADLINE_EXCEEDED", "BUSY", "INTERNAL"];

/** Milliseconds between two tries where one failed, at least. */
const leastBetween = 5000;

/** Keeps the session that is open from expiring for as long as the page is open. */
export class KeepAlive {
  private timer: ReturnType<typeof setTimeout> | undefined;
  private failed = false;

  /** `told` is told why where it did not work, once until it does again. */
  constructor(private readonly told: (problem: ProblemText) => void) {}

  watch(session: Session): void {
    this.end();
    this.failed = false;
    this.again(session, pause(session, Date.now()));
  }

  end(): void {
    clearTimeout(this.timer);
    this.timer = undefined;
  }

  private again(session: Session, after: number): void {
    this.timer = setTimeout(() => void this.call(session), after);
  }

  private async call(session: Session): Promise<void> {
    const mine = this.timer;
    try {
      const kept = await keepAlive(session.id);
      if (this.timer === mine) this.watch(kept); // else another was opened meanwhile
    } catch (error) {
      if (this.timer !== mine) return;
      const problem = problemText(error);
      if (!this.failed) this.told(problem);
      this.failed = true;
      if (passing.includes(problem.cause)) this.again(session, Math.max(pause(session, Date.now()), leastBetween, 1000 * (problem.retryAfter ?? 0)));
    }
  }
}
