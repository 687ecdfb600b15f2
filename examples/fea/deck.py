"""A volume mesh as Gmsh writes it for Abaqus, made into a deck for CalculiX, and what CalculiX says of it."""
import numpy as np

YOUNG, POISSON, DENSITY = 210000.0, 0.3, 7.85e-9  # steel: N/mm^2, t/mm^3


def read_volume(path):
    """Node numbers, their places, faces of six nodes and tetrahedra of ten."""
    nodes, elements, target, row = [], {"CPS6": [], "C3D10": []}, None, []
    with open(path, encoding="ascii") as lines:
        for line in lines:
            if line.startswith("*"):
                upper = line.upper()
                kind = upper.split("TYPE=")[1].split(",")[0].strip() if upper.startswith("*ELEMENT") else None
                target = nodes if upper.startswith("*NODE") else elements.get(kind)
                row = []
            elif target is nodes and target is not None:
                nodes.append([float(number) for number in line.split(",")])
            elif target is not None:
                row += [int(number) for number in line.split(",") if number.strip()]
                if not line.rstrip().endswith(","):
                    target.append(row[1:])
                    row = []
    table = np.array(nodes)
    return table[:, 0].astype(int), table[:, 1:], np.array(elements["CPS6"]), np.array(elements["C3D10"])


class Volume:
    """A volume mesh with its surface; faces are of indices into `points`."""

    def __init__(self, path):
        self.ids, self.points, faces, self.tetrahedra = read_volume(path)
        if len(faces) == 0 or len(self.tetrahedra) == 0:
            raise SystemExit(f"{path}: no second-order tetrahedra with a surface; Gmsh did not mesh the volume")
        index = np.full(self.ids.max() + 1, -1)
        index[self.ids] = np.arange(len(self.ids))
        self.faces = index[faces]

    def faces_on_plane(self, axis, at, within):
        """Those with all corners near the plane across that axis."""
        near = abs(self.points[self.faces[:, :3], axis] - at) < within
        return self.faces[near.all(1)]


def write_deck(path, volume, held, acceleration):
    # CalculiX reads 20 characters of a number.
    with open(path, "w", encoding="ascii") as out:
        out.write("*NODE, NSET=Nall\n")
        for number, (x, y, z) in zip(volume.ids, volume.points):
            out.write(f"{number}, {x:.12g}, {y:.12g}, {z:.12g}\n")
        out.write("*ELEMENT, TYPE=C3D10, ELSET=Eall\n")
        for i, nodes in enumerate(volume.tetrahedra):
            out.write(f"{i + 1}, {', '.join(map(str, nodes))}\n")
        out.write("*NSET, NSET=held\n" + "".join(f"{volume.ids[node]},\n" for node in held))
        out.write(f"*MATERIAL, NAME=steel\n*ELASTIC\n{YOUNG}, {POISSON}\n*DENSITY\n{DENSITY}\n*SOLID SECTION, ELSET=Eall, MATERIAL=steel\n"
                  f"*STEP\n*STATIC\n*BOUNDARY\nheld, 1, 3\n*DLOAD\nEall, GRAV, {acceleration}, 1., 0., 0.\n"
                  "*NODE PRINT, NSET=Nall\nU\n*END STEP\n")


def read_displacements(path, volume):
    with open(path, encoding="ascii") as lines:
        rows = [line.split() for line in lines]
    table = np.array([[float(number) for number in row] for row in rows if len(row) == 4 and row[0].isdigit()])
    index = np.full(volume.ids.max() + 1, -1)
    index[volume.ids] = np.arange(len(volume.ids))
    moved = np.full((len(volume.ids), 3), np.nan)
    moved[index[table[:, 0].astype(int)]] = table[:, 1:]
    if np.isnan(moved).any():
        raise SystemExit(f"{path}: CalculiX tells no displacement of {int(np.isnan(moved).any(1).sum())} nodes")
    return moved
