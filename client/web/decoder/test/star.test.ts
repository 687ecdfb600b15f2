import assert from "node:assert/strict";
import { test } from "node:test";
import { ProgressiveMesh } from "../src/index.js";
import { LookAhead } from "../src/look_ahead.js";
import { Star } from "../src/star.js";

/** Two tips, vertices 0 and 1, over and under a ring of `sides` vertices from 2 on. */
function bipyramid(sides: number): ProgressiveMesh {
  const positions = [0, 0, 1, 0, 0, -1], corners: number[] = [];
  for (let n = 0; n < sides; ++n) {
    const angle = (2 * Math.PI * n) / sides, here = 2 + n, there = 2 + ((n + 1) % sides);
    positions.push(Math.cos(angle) * (n === 5 ? 0.5 : 1), Math.sin(angle) * (n === 5 ? 0.5 : 1), 0);
    corners.push(0, here, there, 1, there, here);
  }
  return new ProgressiveMesh(Float64Array.from(positions), Uint32Array.from(corners));
}

test("a ring of any length begins with the nearest neighbour and goes counter-clockwise", () => {
  for (const sides of [6, 63, 64, 65, 300]) {
    const mesh = bipyramid(sides);
    const star = new Star();
    star.gather(mesh, 0, mesh.cornerOf[0]!);
    assert.equal(star.valence, sides);
    for (let n = 0; n < sides; ++n) {
      assert.equal(star.vertex(n), 2 + ((5 + n) % sides));
      assert.equal(mesh.vertexAt(star.corner(n)), 0);
      assert.equal(mesh.vertexAt(star.corner(n) + 1), star.vertex(n));
    }
  }
});

test("of neighbours as near the one with the lowest number is first, whichever corner the walk begins at", () => {
  const mesh = bipyramid(8);
  const star = new Star();
  for (let corner = mesh.cornerOf[1]!, n = 0; n < 8; ++n, corner = mesh.after(corner)) {
    mesh.positions.set([1, 0, 0], 3 * (2 + 5)); // as near as the others, which are at a distance of sqrt(2)
    star.gather(mesh, 1, corner);
    const squares = Array.from({ length: 8 }, (_, k) => star.vertex(k)).map((v) => [0, 1, 2].reduce((sum, axis) => sum + (mesh.positions[3 * v + axis]! - mesh.positions[3 + axis]!) ** 2, 0));
    const least = Math.min(...squares);
    const nearest = Array.from({ length: 8 }, (_, k) => star.vertex(k)).filter((_, k) => squares[k] === least);
    assert.equal(star.vertex(0), Math.min(...nearest));
  }
});

test("looking ahead leaves out vertices that are not there, and changes nothing", () => {
  const mesh = bipyramid(10);
  const before = [mesh.corners().join(), mesh.positions.join()];
  const places = Int32Array.from({ length: 100 }, (_, n) => (n % 3 === 0 ? ~n : n % 3 === 1 ? n : n % 12));
  const ahead = new LookAhead();
  ahead.begin();
  for (let n = 0; n < 100; ++n) ahead.reach(n, mesh, places, 100);
  assert.deepEqual([mesh.corners().join(), mesh.positions.join()], before);
  assert.equal(ahead.strange, 0);
});
