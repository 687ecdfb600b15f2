import type { Surface } from "./surface";

/** A binary PLY as vsplitd writes it: x, y, z as doubles, then triangles of 32-bit numbers; other properties of faces are not there. */
export function readPly(bytes: ArrayBuffer): Surface {
  const head = new TextDecoder("latin1").decode(bytes.slice(0, 4096));
  const end = head.indexOf("end_header\n") + "end_header\n".length;
  const counted = (element: string): number => Number(new RegExp(`element ${element} (\\d+)`).exec(head)?.[1]);
  const vertexCount = counted("vertex"), faceCount = counted("face");
  const faceBytes = 13 + (head.includes("property uint region") || head.includes("property int region") ? 4 : 0);
  if (!head.startsWith("ply\nformat binary_little_endian 1.0\n") || !(end + 24 * vertexCount + faceBytes * faceCount === bytes.byteLength)) {
    throw new Error("the server's PLY is not as expected");
  }
  const positions = new Float64Array(bytes.slice(end, end + 24 * vertexCount));
  const corners = new Uint32Array(3 * faceCount);
  const view = new DataView(bytes, end + 24 * vertexCount);
  for (let f = 0; f < faceCount; ++f) {
    for (let c = 0; c < 3; ++c) corners[3 * f + c] = view.getUint32(faceBytes * f + 1 + 4 * c, true);
  }
  return { vertexCount, faceCount, ghosts: 0, positions, vertexAt: (corner) => corners[corner]! };
}
