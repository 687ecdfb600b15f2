import { unpackBase, type Grid, type RecordBlock } from "../src/index.js";

/** A stream as tests/core/golden_test.cpp writes it: a line a thing. */
export interface Golden {
  base: { positions: Float64Array; corners: Uint32Array; ghosts: number };
  grid: Grid;
  blocks: { block: RecordBlock; after: string }[];
}

const bytesOf = (hex: string): Uint8Array => Uint8Array.from(Buffer.from(hex, "hex"));

function doubleOf(hex: string): number {
  return Buffer.from(hex, "hex").readDoubleLE(0);
}

export function readGolden(text: string): Golden {
  const lines = text.trim().split("\n").map((line) => line.split(" "));
  const [, vertices, faces, ghosts, encoding, bits, x, y, z, step] = lines.find((line) => line[0] === "base")!;
  const grid: Grid = { encoding: Number(encoding), bits: Number(bits), origin: [doubleOf(x!), doubleOf(y!), doubleOf(z!)], step: doubleOf(step!) };
  const counts = { vertices: Number(vertices), faces: Number(faces), ghosts: Number(ghosts) };
  const packed = lines.find((line) => line[0] === "packed");
  let base: { positions: Float64Array; corners: Uint32Array };
  if (packed) {
    base = unpackBase(bytesOf(packed[1]!), counts, grid);
  } else {
    const positions = bytesOf(lines.find((line) => line[0] === "positions")![1]!);
    const corners = bytesOf(lines.find((line) => line[0] === "corners")![1]!);
    base = { positions: new Float64Array(positions.buffer), corners: new Uint32Array(corners.buffer) };
  }
  const blocks: Golden["blocks"] = [];
  for (const line of lines) {
    if (line[0] === "block") {
      const [, first, count, kind, crc, hex] = line;
      const block = { first: Number(first), count: Number(count), encoding: Number(kind), crc32c: Number(crc), payload: bytesOf(hex!) };
      blocks.push({ block, after: "" });
    } else if (line[0] === "mesh") {
      blocks.at(-1)!.after = line.slice(1).join(" ");
    }
  }
  return { base: { ...base, ghosts: counts.ghosts }, grid, blocks };
}

