import { readFileSync } from "node:fs";
import { expect, test } from "vitest";
import { readGolden } from "../decoder/test/golden";
import { HeldMesh } from "../src/worker/held_mesh";
import { Ramp } from "../src/shared/colours";
import { measure } from "../src/worker/figures";
import { Painter } from "../src/worker/painter";
import { isSeen } from "../src/worker/surface";

const golden = (name: string) => readGolden(readFileSync(new URL(`../../../tests/data/golden/${name}`, import.meta.url), "utf8"));

function load(name: string): HeldMesh {
  const { base, grid, blocks } = golden(name);
  const held = new HeldMesh(base, grid);
  for (const { block } of blocks) held.take(block);
  return held;
}

const valence = new Ramp("valence", [3, 12]);
const names = ["records_1_float32_closed.golden", "records_1_float32_open.golden", "records_1_quantised14_open.golden"];

test.each(names)("%s: any level is the finest of at most so many faces, and comes back the same", (name) => {
  const held = load(name);
  const most = held.visibleHeld;
  const before = new Map<number, string>();
  held.show(0);
  const least = held.visible;
  for (let n = 0; n < 60; ++n) {
    const asked = (n * 7919) % (most + 3);
    held.show(asked);
    const { visible, mesh } = held;
    let counted = 0;
    for (let f = 0; f < mesh.faceCount; ++f) counted += isSeen(mesh, f) ? 1 : 0;
    expect(visible).toBe(counted);
    expect(measure(mesh).faces).toBe(counted);
    expect(visible <= asked || visible === least).toBe(true);
    expect(visible).toBeGreaterThanOrEqual(Math.min(asked, most) - 1);
    const text = mesh.positions.slice(0, 3 * mesh.vertexCount).join() + mesh.corners().join();
    expect(before.get(mesh.level) ?? text).toBe(text);
    before.set(mesh.level, text);
  }
});

test.each(names)("%s: patches make the same faces as drawing all", (name) => {
  const held = load(name);
  const painter = new Painter([1, 2, 3], valence); // the colour that depends on most: on edges to vertices that did not move
  const drawn: number[] = [], coloured: number[] = [];
  held.takeChanges();
  const apply = ({ runs, positions, colours }: { runs: Uint32Array; positions: Float32Array; colours: Uint8Array }) => {
    let from = 0;
    for (let n = 0; n < runs.length; n += 2) {
      for (let k = 0; k < 9 * runs[n + 1]!; ++k) {
        drawn[9 * runs[n]! + k] = positions[from]!;
        coloured[9 * runs[n]! + k] = colours[from++]!;
      }
    }
  };
  apply(painter.whole(held.mesh));
  const most = held.visibleHeld;
  for (const share of [0.9, 0.92, 0.5, 0.51, 1, 0, 0.3, 0.29, 0.28, 1]) {
    held.show(Math.round(share * most));
    apply(painter.some(held.mesh, held.takeChanges()));
    expect(drawn.slice(0, 9 * held.mesh.faceCount)).toEqual([...painter.whole(held.mesh).positions]);
    expect(coloured.slice(0, 9 * held.mesh.faceCount)).toEqual([...painter.whole(held.mesh).colours]);
  }
});

test.each(names)("%s: a face whose colour by valence changes is among the changes", (name) => {
  const held = load(name);
  const painter = new Painter([0, 0, 0], valence);
  held.takeChanges();
  let before = painter.whole(held.mesh).colours;
  for (let faces = held.visibleHeld - 2, n = 0; n < 40; ++n, faces += n % 3 === 2 ? 2 : -2) {
    held.show(faces);
    const changes = new Set(held.takeChanges());
    const { colours } = painter.whole(held.mesh);
    for (let f = 0; f < held.mesh.faceCount; ++f) {
      const same = colours.subarray(9 * f, 9 * f + 9).every((value, k) => value === before[9 * f + k]);
      expect(same || changes.has(f)).toBe(true);
    }
    before = colours;
  }
});

test.each(names)("%s: a patch tells the sizes of its faces", (name) => {
  const held = load(name);
  const painter = new Painter([0, 0, 0], valence);
  for (const share of [1, 0.5, 0.98]) {
    held.show(Math.round(share * held.visibleHeld));
    const { sizes } = measure(held.mesh);
    expect(painter.whole(held.mesh).sizes).toEqual(sizes);
    const some = painter.some(held.mesh, Uint32Array.of(held.mesh.faceCount - 1)).sizes;
    expect(some[0]).toBeGreaterThanOrEqual(sizes[0]);
    expect(some[1]).toBeLessThanOrEqual(sizes[1]);
    expect(some[0]).toBe(some[1]);
  }
});
