"""Meshes for tests of faults, each of its own bytes."""

import math
import struct


def bumpy_torus(around, across, seed):
    """Binary STL of 2 * around * across faces; another seed gives another mesh of as many faces."""

    def point(i, j):
        u, v = 2 * math.pi * (i % around) / around, 2 * math.pi * (j % across) / across
        r = 0.4 + 0.02 * math.sin(5 * u + 0.1 * seed)
        return ((1 + r * math.cos(v)) * math.cos(u), (1 + r * math.cos(v)) * math.sin(u), r * math.sin(v))

    faces = []
    for i in range(around):
        for j in range(across):
            a, b, c, d = point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)
            faces += [(a, b, c), (a, c, d)]
    body = b"".join(struct.pack("<12fH", 0, 0, 0, *f[0], *f[1], *f[2], 0) for f in faces)
    return b"a torus".ljust(80) + struct.pack("<I", len(faces)) + body
