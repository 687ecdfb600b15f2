/** What was received is damaged, or does not fit what came before. */
export class CorruptError extends Error {
  override name = "CorruptError";
}
