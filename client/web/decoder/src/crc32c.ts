import { sharedEngine } from "./engine.js";

/** So many bytes at a time, for an engine's memory only ever grows. */
const part = 65536;

/** CRC-32C (Castagnoli). */
export function crc32c(bytes: Uint8Array): number {
  let crc = 0;
  for (let at = 0; at < bytes.length; at += part) crc = sharedEngine().crc32c(bytes.subarray(at, at + part), crc);
  return crc;
}
