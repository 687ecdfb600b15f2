const table = new Uint32Array(256);
for (let byte = 0; byte < 256; ++byte) {
  let crc = byte;
  for (let bit = 0; bit < 8; ++bit) crc = (crc >>> 1) ^ (crc & 1 ? 0x82f63b78 : 0);
  table[byte] = crc;
}

/** CRC-32C (Castagnoli). */
export function crc32c(bytes: Uint8Array): number {
  let crc = 0xffffffff;
  for (let n = 0; n < bytes.length; ++n) crc = (crc >>> 8) ^ table[(crc ^ bytes[n]!) & 0xff]!;
  return ~crc >>> 0;
}
