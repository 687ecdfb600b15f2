import type { Representation } from "../gen/vsplit/v1/meshing_pb";

/** What the server is asked about a resolution. */
export type AskAt = (faces: number, signal: AbortSignal) => Promise<Representation>;

/**
 * What the server says of the resolution that is shown: figures and broken bounds are of one resolution, and the page goes to others
 * by itself. Asked once a resolution, when it stays for a while; of questions the last counts.
 */
export class Resting {
  private said: Representation | undefined;
  private asked: { faces: number; control: AbortController } | undefined;

  /** `heard`: when an answer is there, or there will be none. */
  constructor(private readonly heard: (error?: unknown) => void) {}

  /** The server's word about `faces` faces; undefined where it is not known. */
  at(faces: number): Representation | undefined {
    return this.said?.faces === faces ? this.said : undefined;
  }

  /** Whether the answer about `faces` is on its way. */
  waits(faces: number): boolean {
    return this.asked?.faces === faces;
  }

  /** The server has told it unasked. */
  take(said: Representation): void {
    this.clear();
    this.said = said;
  }

  ask(faces: number, how: AskAt): void {
    if (this.at(faces) || this.waits(faces)) return;
    this.asked?.control.abort();
    const own = (this.asked = { faces, control: new AbortController() });
    how(faces, own.control.signal).then(
      (said) => this.end(own, () => (this.said = said)),
      (error: unknown) => this.end(own, () => undefined, error),
    );
  }

  clear(): void {
    this.asked?.control.abort();
    this.asked = this.said = undefined;
  }

  private end(own: Resting["asked"], then: () => void, error?: unknown): void {
    if (this.asked !== own) return; // another question, or another mesh
    this.asked = undefined;
    then();
    this.heard(error);
  }
}
