#!/usr/bin/python3
"""Makes a noisy, closed, scan-like surface: a bust of smooth blobs, cut out of a grid by marching tetrahedra, with noise along the normals.

Usage: scan.py OUT.ply        (plain Python 3; lengths in mm; same bytes on every run)
"""
import math
import random
import struct
import sys

CELL = 2.8
SEED = 20050601
NOISE = 0.10
# Centre, radii and share of each blob: base, chest, neck, head, nose, ears, bun.
BLOBS = [((0, 0, 12), (33, 31, 17)), ((0, 0, 46), (40, 25, 26)), ((0, 2, 84), (15, 15, 24)), ((0, -2, 122), (25, 30, 33)),
         ((0, -31, 116), (6, 9, 9)), ((27, 4, 118), (6, 9, 11)), ((-27, 4, 118), (6, 9, 11)), ((0, 30, 134), (15, 14, 15)),
         ((0, -26, 128), (20, 7, 5)), ((0, -25, 103), (9, 7, 6))]
TETRAHEDRA = ((0, 5, 1, 6), (0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6), (0, 4, 5, 6))
CORNERS = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))


def field(x, y, z):
    """Positive inside. Blobs melt together; a ripple gives the surface texture."""
    total = 0.0
    for (cx, cy, cz), (rx, ry, rz) in BLOBS:
        square = ((x - cx) / rx) ** 2 + ((y - cy) / ry) ** 2 + ((z - cz) / rz) ** 2
        if square < 9:
            total += math.exp(-2.0 * (square - 1.0))
    return total - 1.0 + 0.05 * math.sin(0.45 * z + 0.8 * math.sin(0.21 * x)) * math.sin(0.37 * x + 0.2 * y)


def grid_point(key):
    return tuple(CELL * k for k in key)


class Surface:
    def __init__(self):
        self.values = {}
        self.ids = {}
        self.points = []
        self.faces = []

    def value(self, key):
        if key not in self.values:
            self.values[key] = field(*grid_point(key))
        return self.values[key]

    def crossing(self, inner, outer):
        """Vertex where the surface crosses a grid edge; kept off the grid points so that no face collapses."""
        edge = (inner, outer)
        if edge not in self.ids:
            a, b = self.value(inner), self.value(outer)
            share = min(0.95, max(0.05, a / (a - b)))
            self.ids[edge] = len(self.points)
            self.points.append([p + share * (q - p) for p, q in zip(grid_point(inner), grid_point(outer))])
        return self.ids[edge]

    def tetrahedron(self, keys):
        inner = [key for key in keys if self.value(key) > 0]
        outer = [key for key in keys if self.value(key) <= 0]
        if len(inner) == 1:
            self.face([self.crossing(inner[0], key) for key in outer], inner, outer)
        elif len(inner) == 3:
            self.face([self.crossing(key, outer[0]) for key in inner], inner, outer)
        elif len(inner) == 2:
            a, b = (self.crossing(inner[0], key) for key in outer)
            c, d = (self.crossing(inner[1], key) for key in outer)
            self.face([a, b, d], inner, outer)
            self.face([a, d, c], inner, outer)

    def face(self, corners, inner, outer):
        """Adds a face, turned so that its normal points out of the body."""
        p, q, r = (self.points[corner] for corner in corners)
        middle = [sum(CELL * key[k] for key in outer) / len(outer) - sum(CELL * key[k] for key in inner) / len(inner) for k in range(3)]
        normal = cross([q[k] - p[k] for k in range(3)], [r[k] - p[k] for k in range(3)])
        if sum(normal[k] * middle[k] for k in range(3)) < 0:
            corners = [corners[0], corners[2], corners[1]]
        self.faces.append(tuple(corners))


def cross(u, v):
    return [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]


def march():
    surface = Surface()
    reach = [(-55, 55), (-55, 60), (-15, 170)]
    low = [math.floor(lo / CELL) for lo, _ in reach]
    high = [math.ceil(hi / CELL) for _, hi in reach]
    for i in range(low[0], high[0]):
        for j in range(low[1], high[1]):
            for k in range(low[2], high[2]):
                keys = [(i + a, j + b, k + c) for a, b, c in CORNERS]
                inside = [surface.value(key) > 0 for key in keys]
                if any(inside) and not all(inside):
                    for tetrahedron in TETRAHEDRA:
                        surface.tetrahedron([keys[corner] for corner in tetrahedron])
    return surface


def add_noise(surface):
    """Moves every vertex along its normal, as a scanner's depth noise does."""
    normals = [[0.0, 0.0, 0.0] for _ in surface.points]
    for face in surface.faces:
        p, q, r = (surface.points[corner] for corner in face)
        normal = cross([q[k] - p[k] for k in range(3)], [r[k] - p[k] for k in range(3)])
        for corner in face:
            for k in range(3):
                normals[corner][k] += normal[k]
    numbers = random.Random(SEED)
    for point, normal in zip(surface.points, normals):
        length = math.hypot(*normal)
        shift = numbers.uniform(-NOISE, NOISE)
        for k in range(3):
            point[k] += shift * normal[k] / length


def write_ply(path, surface):
    with open(path, "wb") as out:
        out.write(b"ply\nformat binary_little_endian 1.0\n")
        out.write(f"element vertex {len(surface.points)}\nproperty float x\nproperty float y\nproperty float z\n".encode())
        out.write(f"element face {len(surface.faces)}\nproperty list uchar int vertex_indices\nend_header\n".encode())
        for point in surface.points:
            out.write(struct.pack("<3f", *point))
        for face in surface.faces:
            out.write(struct.pack("<B3i", 3, *face))


def main():
    if len(sys.argv) != 2:
        raise SystemExit(__doc__)
    surface = march()
    add_noise(surface)
    write_ply(sys.argv[1], surface)


main()
