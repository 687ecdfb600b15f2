/** tables[k][b]: what the byte b does to the checksum when k bytes follow it. Four bytes at a time need not wait for each other. */
const tables = [0, 1, 2, 3].map(() => new Int32Array(256)) as [Int32Array, Int32Array, Int32Array, Int32Array];
for (let byte = 0; byte < 256; ++byte) {
  let crc = byte;
  for (let bit = 0; bit < 8; ++bit) crc = (crc >>> 1) ^ (crc & 1 ? 0x82f63b78 : 0);
  tables[0][byte] = crc;
}
for (let k = 1; k < 4; ++k) {
  for (let byte = 0; byte < 256; ++byte) {
    const before = tables[k - 1]![byte]!;
    tables[k]![byte] = (before >>> 8) ^ tables[0][before & 0xff]!;
  }
}

/** CRC-32C (Castagnoli). */
export function crc32c(bytes: Uint8Array): number {
  const [t0, t1, t2, t3] = tables;
  const { length } = bytes;
  let crc = -1;
  let n = 0;
  for (; n + 4 <= length; n += 4) {
    const four = crc ^ (bytes[n]! | (bytes[n + 1]! << 8) | (bytes[n + 2]! << 16) | (bytes[n + 3]! << 24));
    crc = t3[four & 0xff]! ^ t2[(four >>> 8) & 0xff]! ^ t1[(four >>> 16) & 0xff]! ^ t0[four >>> 24]!;
  }
  for (; n < length; ++n) crc = (crc >>> 8) ^ t0[(crc ^ bytes[n]!) & 0xff]!;
  return ~crc >>> 0;
}
