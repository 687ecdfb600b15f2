import { Engine } from "./engine.js";

/** So many bytes at a time are given to an engine that stays. */
const part = 65536;
let engine: Engine | undefined;

/** CRC-32C (Castagnoli). */
export function crc32c(bytes: Uint8Array): number {
  engine ??= new Engine();
  let crc = 0;
  for (let at = 0; at < bytes.length; at += part) crc = engine.crc32c(bytes.subarray(at, at + part), crc);
  return crc;
}
