"""A representation that a client holds, as far as it has come."""

import pathlib

import numpy as np

from .decoder import CorruptError, Decoder


class _Shown:
    """What gives points (n, 3) and triangles (m, 3) by `at`, in the forms of others."""

    def meshio_at(self, faces=None):
        """Arguments of meshio.Mesh."""
        points, triangles = self.at(faces)
        return points, [("triangle", triangles)]

    def pyvista_at(self, faces=None):
        """Arguments of pyvista.PolyData."""
        points, triangles = self.at(faces)
        return points, np.hstack([np.full((len(triangles), 1), 3, np.int64), triangles.astype(np.int64)]).ravel()


class StoredMesh(_Shown):
    """All resolutions of a `.vsplit` file, made by load."""

    def __init__(self, data):
        self._decoder = Decoder()
        self._decoder.load(data)
        self._made_for = self._decoder.shown()[1].shape[0]

    @property
    def faces_max(self):
        return self._decoder.faces_held

    def at(self, faces=None):
        """Points (n, 3) and triangles (m, 3) at the resolution nearest to `faces`; None: the one it was made for."""
        self._decoder.show(self._made_for if faces is None else faces)
        return self._decoder.shown()


def load(path):
    """A StoredMesh of a `.vsplit` file. Raises CorruptError that says at which byte it is damaged, of a newer version or none."""
    return StoredMesh(pathlib.Path(path).read_bytes())


class Mesh(_Shown):
    """Made by Client.improve, control and open. `representation` is the vsplit.v1.Representation."""

    def __init__(self, client, session, encoding, bits):
        self._client, self._session = client, session
        self._encoding, self._bits = encoding, bits
        self._decoder = Decoder()
        self._parts = []
        self.representation = None
        self.max_error = 0.0

    def at(self, faces=None):
        """Points (n, 3) and triangles (m, 3) at the resolution nearest to `faces`; None: the one it was made for. Fetches what is
        missing."""
        wanted = self.representation.faces if faces is None else faces
        if wanted > self._decoder.faces_held or not self._decoder.faces_held:
            self._client._fetch(self, wanted)
        self._decoder.show(wanted)
        return self._decoder.shown()

    def _take(self, event):
        kind = event.WhichOneof("event")
        if kind == "base_mesh":
            self._take_base(event.base_mesh)
        elif kind == "record_block":
            self._decoder.append(event.record_block)
        elif kind == "representation":
            self.representation = self.representation or event.representation

    def _take_base(self, part):
        self._parts.append(part)
        self.max_error = part.max_error
        if part.packed_size:
            packed = b"".join(p.packed for p in self._parts)
            if len(packed) < part.packed_size:
                return
            self._decoder.begin_packed(packed, part)
        else:
            positions = np.frombuffer(b"".join(p.positions for p in self._parts), "<f8").reshape(-1, 3)
            indices = np.frombuffer(b"".join(p.indices for p in self._parts), "<u4").reshape(-1, 3)
            if len(positions) < part.vertices or len(indices) < part.faces:
                return
            if len(positions) > part.vertices or len(indices) > part.faces:
                raise CorruptError("base mesh: more data than was announced")
            self._decoder.begin(positions, indices, part.ghosts)
        self._parts = []
