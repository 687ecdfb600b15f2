#!/usr/bin/python3
"""Models the crankshaft (four throws, five mains) with OpenCASCADE through Gmsh and writes it as a boundary representation.

Usage: crankshaft.py OUT.brep        (Debian: python3-gmsh; lengths in mm)
The axis of rotation is z. scripts/remake in this folder tessellates the result into crankshaft.stl.
"""
import math
import sys

import gmsh

MAIN_RADIUS, MAIN_LENGTH = 44.0, 26.0
PIN_RADIUS, PIN_LENGTH = 38.0, 34.0
PIN_BORE_RADIUS = 13.0
THROW = 92.0
WEB_THICKNESS, WEB_HALF_WIDTH = 22.0, 115.0
COUNTERWEIGHT_RADIUS = 198.0
NOSE_RADIUS, NOSE_LENGTH = 30.0, 50.0
FLANGE_RADIUS, FLANGE_LENGTH = 88.0, 24.0
OIL_HOLE_RADIUS = 4.5
FILLET = 3.5
CHAMFER = 2.5
THROW_ANGLES = (0.0, 180.0, 180.0, 0.0)

occ = None


def cylinder(x, y, z, length, radius):
    return (3, occ.addCylinder(x, y, z, 0, 0, length, radius))


def fuse(first, *others):
    return occ.fuse([first], list(others))[0][0]


def cut(first, tools):
    return occ.cut([first], tools)[0][0]


def web(z):
    """One web in the frame of its throw: pin towards +x, counterweight towards -x."""
    arm = fuse(cylinder(0, 0, z, WEB_THICKNESS, 70.0), cylinder(THROW, 0, z, WEB_THICKNESS, 62.0),
               (3, occ.addBox(0, -60, z, THROW, 120, WEB_THICKNESS)))
    disc = cylinder(0, 0, z, WEB_THICKNESS, COUNTERWEIGHT_RADIUS)
    keep = (3, occ.addBox(-COUNTERWEIGHT_RADIUS - 1, -WEB_HALF_WIDTH, z, COUNTERWEIGHT_RADIUS - 29, 2 * WEB_HALF_WIDTH, WEB_THICKNESS))
    weight = occ.intersect([disc], [keep])[0][0]
    body = fuse(arm, weight)
    tools = []
    # Lightening slots at both sides of the main journal, and balancing bores of growing size along the counterweight's rim.
    for side in (-1, 1):
        tools.append(cylinder(-92, side * 62, z - 1, WEB_THICKNESS + 2, 24.0))
        for step, radius in enumerate((6.0, 8.5, 11.0)):
            angle = math.radians(180 + side * (6 + 8.5 * step))
            tools.append(cylinder(178 * math.cos(angle), 178 * math.sin(angle), z - 1, WEB_THICKNESS + 2, radius))
    return cut(body, tools)


def rounded(body, radius, wanted, chamfer=False):
    """Fillets (or chamfers) the edges whose bounding box `wanted` accepts."""
    occ.synchronize()
    edges = [tag for _, tag in gmsh.model.getBoundary([body], combined=True, oriented=False, recursive=False) for _, tag in
             gmsh.model.getBoundary([(2, tag)], oriented=False)]
    chosen = sorted({tag for tag in edges if wanted(gmsh.model.getBoundingBox(1, tag))})
    if not chosen:
        raise SystemExit("crankshaft.py: no edge to round")
    if not chamfer:
        return occ.fillet([body[1]], chosen, [radius])[0]
    faces = []
    for edge in chosen:
        faces.append(gmsh.model.getAdjacencies(1, edge)[0][0])
    return occ.chamfer([body[1]], chosen, faces, [radius])[0]


def flat(box):
    """The z of an edge that lies in a plane across the axis, or None."""
    return box[2] if box[5] - box[2] < 1e-3 else None


def throw(z, angle):
    """Web, bored pin, web, with the counterweights' rims chamfered and the pin's ends filleted; turned to its angle."""
    first, second = web(z), web(z + WEB_THICKNESS + PIN_LENGTH)
    outer = []
    for body, bottom in ((first, z), (second, z + WEB_THICKNESS + PIN_LENGTH)):
        outer.append(rounded(body, CHAMFER, lambda box: flat(box) is not None and box[0] < 3 - COUNTERWEIGHT_RADIUS, chamfer=True))
    pin = cylinder(THROW, 0, z + WEB_THICKNESS, PIN_LENGTH, PIN_RADIUS)
    body = fuse(outer[0], outer[1], pin)
    ends = (z + WEB_THICKNESS, z + WEB_THICKNESS + PIN_LENGTH)
    body = rounded(body, FILLET, lambda box: flat(box) is not None and min(abs(box[2] - end) for end in ends) < 1e-3
                   and abs(box[3] - box[0] - 2 * PIN_RADIUS) < 0.5)
    body = cut(body, [cylinder(THROW, 0, z - 1, 2 * WEB_THICKNESS + PIN_LENGTH + 2, PIN_BORE_RADIUS)])
    occ.rotate([body], 0, 0, 0, 0, 0, 1, math.radians(angle))
    return body


def flange(z):
    body = cylinder(0, 0, z, FLANGE_LENGTH, FLANGE_RADIUS)
    tools = [cylinder(0, 0, z + FLANGE_LENGTH - 16, 17, 24.0)]
    for step in range(8):
        angle = math.radians(45 * step + 22.5)
        tools.append(cylinder(66 * math.cos(angle), 66 * math.sin(angle), z - 1, FLANGE_LENGTH + 2, 7.0))
    tools.append(cylinder(66, 0, z - 1, FLANGE_LENGTH + 2, 4.0))
    body = cut(body, tools)
    return rounded(body, 2.0, lambda box: flat(box) is not None and box[3] - box[0] > 2 * FLANGE_RADIUS - 1)


def nose():
    body = cylinder(0, 0, 0, NOSE_LENGTH, NOSE_RADIUS)
    body = rounded(body, 3.0, lambda box: flat(box) is not None and box[2] < 1e-3, chamfer=True)
    keyway = [(3, occ.addBox(NOSE_RADIUS - 6, -5, 12, 10, 10, 30)), cylinder(0, 0, -1, 26, 10.0)]
    return cut(body, keyway)


def oil_hole(main_z, pin_z, angle):
    """A drilling that goes straight from a main journal's surface through a web to the far side of the pin."""
    start, end = -MAIN_RADIUS - 5, THROW + PIN_RADIUS + 5
    tag = occ.addCylinder(start, 0, main_z - 3, end - start, 0, pin_z - main_z + 3, OIL_HOLE_RADIUS)
    occ.rotate([(3, tag)], 0, 0, 0, 0, 0, 1, math.radians(angle))
    return (3, tag)


def crankshaft():
    parts, mains, pins = [nose()], [], []
    z = NOSE_LENGTH
    pitch = 2 * WEB_THICKNESS + PIN_LENGTH + MAIN_LENGTH
    for index, angle in enumerate(THROW_ANGLES):
        bottom = z + index * pitch
        parts.append(cylinder(0, 0, bottom, MAIN_LENGTH, MAIN_RADIUS))
        mains.append(bottom + MAIN_LENGTH / 2)
        parts.append(throw(bottom + MAIN_LENGTH, angle))
        pins.append(bottom + MAIN_LENGTH + WEB_THICKNESS + PIN_LENGTH / 2)
    top = z + len(THROW_ANGLES) * pitch
    parts.append(cylinder(0, 0, top, MAIN_LENGTH, MAIN_RADIUS))
    parts.append(flange(top + MAIN_LENGTH))
    body = fuse(*parts)
    ends = [z + index * pitch + offset for index in range(len(THROW_ANGLES) + 1) for offset in (0, MAIN_LENGTH)]
    body = rounded(body, FILLET, lambda box: flat(box) is not None and min(abs(box[2] - end) for end in ends) < 1e-3
                   and abs(box[3] - box[0] - 2 * MAIN_RADIUS) < 0.5 and box[2] > z + 1)
    return cut(body, [oil_hole(*place) for place in zip(mains, pins, THROW_ANGLES)])


def main():
    global occ
    if len(sys.argv) != 2:
        raise SystemExit(__doc__)
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    occ = gmsh.model.occ
    crankshaft()
    occ.synchronize()
    volumes = gmsh.model.getEntities(3)
    if len(volumes) != 1:
        raise SystemExit(f"crankshaft.py: {len(volumes)} bodies instead of one")
    gmsh.write(sys.argv[1])
    gmsh.finalize()


main()
