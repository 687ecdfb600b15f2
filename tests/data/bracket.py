#!/usr/bin/python3
"""Models a bearing bracket (plate, wall, bored boss, two ribs, slots, fillets) with OpenCASCADE through Gmsh.

Usage: bracket.py OUT.brep        (Debian: python3-gmsh; lengths in mm)
scripts/remake in this folder tessellates the result into bracket.stl.
"""
import math
import sys

import gmsh

PLATE = (160.0, 100.0, 14.0)
WALL_X, WALL_THICKNESS, BORE_HEIGHT = 60.0, 24.0, 88.0
BOSS_RADIUS, BORE_RADIUS, BOSS_LENGTH = 40.0, 24.0, 46.0
CORNER = 14.0

occ = None


def plate():
    length, width, height = PLATE
    body = (3, occ.addBox(0, 0, 0, length, width, height))
    occ.synchronize()
    upright = [tag for dim, tag in gmsh.model.getEntities(1) if spans(tag)[2] > height - 1e-3]
    body = occ.fillet([body[1]], upright, [CORNER])[0]
    holes = []
    for x in (18.0, length - 18.0):
        for y in (18.0, width - 18.0):
            holes.append((3, occ.addCylinder(x, y, -1, 0, 0, height + 2, 5.5)))
            holes.append((3, occ.addCylinder(x, y, height - 6, 0, 0, 7, 9.5)))
    holes.append(slot(120, 50, 16, 7))
    return occ.cut([body], holes)[0][0]


def slot(x, y, half, radius):
    """A through slot along y."""
    depth = PLATE[2] + 2
    ends = [(3, occ.addCylinder(x, y + side * half, -1, 0, 0, depth, radius)) for side in (-1, 1)]
    return occ.fuse([(3, occ.addBox(x - radius, y - half, -1, 2 * radius, 2 * half, depth))], ends)[0][0]


def spans(tag):
    box = gmsh.model.getBoundingBox(1, tag)
    return [box[3 + k] - box[k] for k in range(3)]


def wall():
    width = PLATE[1]
    body = (3, occ.addBox(WALL_X, width / 2 - BOSS_RADIUS, PLATE[2], WALL_THICKNESS, 2 * BOSS_RADIUS, BORE_HEIGHT - PLATE[2]))
    boss = (3, occ.addCylinder(WALL_X - 11, width / 2, BORE_HEIGHT, BOSS_LENGTH, 0, 0, BOSS_RADIUS))
    return occ.fuse([body], [boss])[0][0]


def rib(y):
    """A triangular rib from the plate to the wall, 10 mm thick."""
    base, top = PLATE[2] - 1, BORE_HEIGHT - 36
    corners = [(WALL_X + 4, base), (PLATE[0] - 30, base), (PLATE[0] - 30, base + 6), (WALL_X + WALL_THICKNESS + 6, top), (WALL_X + 4, top)]
    points = [occ.addPoint(x, y, z) for x, z in corners]
    lines = [occ.addLine(points[k], points[(k + 1) % len(points)]) for k in range(len(points))]
    face = occ.addPlaneSurface([occ.addCurveLoop(lines)])
    return [entity for entity in occ.extrude([(2, face)], 0, 10, 0) if entity[0] == 3][0]


def bolt_circle():
    middle = PLATE[1] / 2
    turned = []
    for step in range(6):
        hole = (3, occ.addCylinder(WALL_X - 20, middle, BORE_HEIGHT + 32, 120, 0, 0, 3.0))
        occ.rotate([hole], 0, middle, BORE_HEIGHT, 1, 0, 0, math.radians(60 * step + 30))
        turned.append(hole)
    return turned


def fillet_circles(body, radius, circle, x):
    """Rounds the boss's edges: circles of the given radius in the plane of that x."""
    occ.synchronize()
    chosen = [tag for _, tag in gmsh.model.getEntities(1)
              if spans(tag)[0] < 1e-3 and abs(spans(tag)[1] - 2 * circle) < 0.5 and abs(gmsh.model.getBoundingBox(1, tag)[0] - x) < 1e-3]
    if not chosen:
        raise SystemExit("bracket.py: no edge to round")
    return occ.fillet([body[1]], chosen, [radius])[0]


def bracket():
    middle = PLATE[1] / 2
    body = occ.fuse([plate()], [wall(), rib(middle - 38), rib(middle + 28)])[0][0]
    bore = (3, occ.addCylinder(WALL_X - 20, middle, BORE_HEIGHT, 120, 0, 0, BORE_RADIUS))
    seat = (3, occ.addCylinder(WALL_X - 20, middle, BORE_HEIGHT, 20, 0, 0, BORE_RADIUS + 4))
    oiler = (3, occ.addCylinder(WALL_X + WALL_THICKNESS / 2, middle, BORE_HEIGHT, 0, 0, 60, 4.0))
    body = occ.cut([body], [bore, seat, oiler])[0][0]
    body = fillet_circles(body, 3.0, BOSS_RADIUS, WALL_X - 11)
    body = fillet_circles(body, 3.0, BOSS_RADIUS, WALL_X - 11 + BOSS_LENGTH)
    return occ.cut([body], bolt_circle())[0][0]


def main():
    global occ
    if len(sys.argv) != 2:
        raise SystemExit(__doc__)
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    occ = gmsh.model.occ
    bracket()
    occ.synchronize()
    volumes = gmsh.model.getEntities(3)
    if len(volumes) != 1:
        raise SystemExit(f"bracket.py: {len(volumes)} bodies instead of one")
    gmsh.write(sys.argv[1])
    gmsh.finalize()


main()
