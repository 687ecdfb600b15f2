#!/usr/bin/python3
"""Checks that meshes (STL or PLY) are closed, oriented 2-manifolds once equal vertices are welded, and prints their figures.

Usage: check_mesh.py FILE...         (plain Python 3; exit status 1 when a mesh is not what it should be)
Independent of the engine on purpose: the test data must not be judged by the code under test.
"""
import math
import struct
import sys


def read_stl(data):
    if data[:5] == b"solid" and len(data) != 84 + 50 * int.from_bytes(data[80:84], "little"):
        rows = [tuple(map(float, line.split()[1:])) for line in data.decode().splitlines() if line.strip().startswith("vertex")]
        return weld(rows)
    count = int.from_bytes(data[80:84], "little")
    if len(data) != 84 + 50 * count:
        raise SystemExit(f"binary STL of {count} faces has {len(data)} bytes")
    return weld([row[k:k + 3] for row in struct.iter_unpack("<12fH", data[84:]) for k in (3, 6, 9)])


def weld(corners):
    ids, points, faces = {}, [], []
    for corner in corners:
        if corner not in ids:
            ids[corner] = len(points)
            points.append(corner)
        faces.append(ids[corner])
    return points, [tuple(faces[i:i + 3]) for i in range(0, len(faces), 3)]


def read_ply(data):
    end = data.index(b"end_header\n") + len(b"end_header\n")
    header = data[:end].decode().split("\n")
    if "format binary_little_endian 1.0" not in header:
        raise SystemExit("only little-endian PLY is read here")
    vertices, count = (int(line.split()[2]) for line in header if line.startswith("element"))
    points = list(struct.iter_unpack("<3f", data[end:end + 12 * vertices]))
    faces = [row[1:] for row in struct.iter_unpack("<B3i", data[end + 12 * vertices:])]
    assert len(faces) == count
    return weld([points[vertex] for face in faces for vertex in face])


def figures(points, faces):
    stretches, longest, below = [], 0.0, 0
    for face in faces:
        a, b, c = (points[vertex] for vertex in face)
        edges = [math.dist(a, b), math.dist(b, c), math.dist(c, a)]
        u, v = [b[k] - a[k] for k in range(3)], [c[k] - a[k] for k in range(3)]
        area = 0.5 * math.hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
        longest = max(longest, max(edges))
        stretch = 2 * math.sqrt(12) * area / (sum(edges) * max(edges)) if max(edges) > 0 else 0.0
        stretches.append(stretch)
        below += stretch < 0.2
    return min(stretches), sum(stretches) / len(stretches), below / len(faces), longest


def components(count, faces):
    parent = list(range(count))

    def root(vertex):
        while parent[vertex] != vertex:
            parent[vertex] = parent[parent[vertex]]
            vertex = parent[vertex]
        return vertex

    for a, b, c in faces:
        parent[root(a)] = root(b)
        parent[root(b)] = root(c)
    return len({root(vertex) for vertex in range(count)})


def fans(faces):
    """Vertices around which the faces are more than one fan."""
    around, bad = {}, 0
    for a, b, c in faces:
        for vertex, entry, leave in ((a, b, c), (b, c, a), (c, a, b)):
            around.setdefault(vertex, {})[entry] = leave
    for steps in around.values():
        start = vertex = next(iter(steps))
        seen = 0
        while seen == 0 or vertex != start:
            vertex = steps.get(vertex)
            seen += 1
            if vertex is None or seen > len(steps):
                break
        bad += seen != len(steps)
    return bad, max(len(steps) for steps in around.values())


def check(path):
    data = open(path, "rb").read()
    points, faces = read_ply(data) if data[:3] == b"ply" else read_stl(data)
    edges = set()
    twice = 0
    for face in faces:
        for k in range(3):
            edge = (face[k], face[(k + 1) % 3])
            twice += edge in edges
            edges.add(edge)
    single = sum((b, a) not in edges for a, b in edges)
    collapsed = sum(len(set(face)) < 3 for face in faces)
    bad_vertices, valence = fans(faces)
    parts = components(len(points), faces)
    genus = (2 * parts - (len(points) - len(edges) // 2 + len(faces))) // 2
    low, mean, below, longest = figures(points, faces)
    good = twice == single == collapsed == bad_vertices == 0
    box = "x".join(f"{max(p[k] for p in points) - min(p[k] for p in points):.1f}" for k in range(3))
    print(f"{path}: V {len(points)} F {len(faces)} {'closed 2-manifold' if good else 'NOT a closed 2-manifold'} components {parts} genus {genus} "
          f"stretch min {low:.3g} mean {mean:.3f} under 0.2 {below:.3f} max valence {valence} max edge {longest:.2f} box {box}")
    if not good:
        print(f"  edges used twice {twice}, edges with one face {single}, faces with two equal corners {collapsed}, vertices with several fans {bad_vertices}")
    return good


def main():
    if len(sys.argv) < 2:
        raise SystemExit(__doc__)
    results = [check(path) for path in sys.argv[1:]]
    sys.exit(0 if all(results) else 1)


main()
