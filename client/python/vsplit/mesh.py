"""A representation that a client holds, as far as it has come."""

import operator
import pathlib

import numpy as np

from .decoder import CorruptError, Decoder
from .v1 import meshing_pb2 as v1
from .words import word_of


def _resolution(faces):
    """`faces` as what a resolution may be asked for by."""
    whole = operator.index(faces)  # numpy's integers too; TypeError for others
    if not 0 < whole < 2**32:
        raise ValueError(f"faces is {whole}; accepted is a whole number from 1 to {2**32 - 1}, of which the nearest is taken")
    return whole


class _Shown:
    """What has points (n, 3), triangles (m, 3) and regions (m,) at any resolution, also in the forms of others. Not thread-safe.

    `faces` is a resolution, of which the nearest that there is is taken; None is the one that the mesh was made for.
    """

    def at(self, faces=None):
        """Points (n, 3), float64, and triangles (m, 3), uint32."""
        self._show(faces)
        return self._decoder.shown()

    def regions_at(self, faces=None):
        """The region of each triangle of at(faces), uint32 (m,); None where the mesh has no regions."""
        self._show(faces)
        return self._decoder.shown_regions()

    @property
    def sets(self):
        """The regions (k,) that each name stands for, as a dict; sets may overlap. Empty where the mesh has none."""
        found = {}
        for name, regions in self._decoder.sets():
            found[name] = np.union1d(found[name], regions) if name in found else regions
        return found

    def sets_at(self, faces=None):
        """The triangles of at(faces) that are in each set: a dict of ascending numbers (k,) by name."""
        self._show(faces)
        return self._shown_sets()

    def meshio_at(self, faces=None):
        """Arguments of meshio.Mesh, 7 of them: points, cells, and with regions cell_data "region" and cell_sets."""
        points, triangles = self.at(faces)
        regions = self._decoder.shown_regions()
        data = {} if regions is None else {"region": [regions]}
        sets = {name: [members] for name, members in self._shown_sets().items()}
        return points, [("triangle", triangles)], None, data, None, None, sets

    def pyvista_at(self, faces=None):
        """Arguments of pyvista.PolyData, whose cell_data["region"] takes regions_at(faces)."""
        points, triangles = self.at(faces)
        return points, np.hstack([np.full((len(triangles), 1), 3, np.int64), triangles.astype(np.int64)]).ravel()

    def _shown_sets(self):
        regions = self._decoder.shown_regions()
        return {name: np.flatnonzero(np.isin(regions, members)) for name, members in self.sets.items()}


class StoredMesh(_Shown):
    """All resolutions of a `.vsplit` file, made by load. `unit`: of its lengths, "mm" for example; "" where that is not known."""

    def __init__(self, data):
        self._decoder = Decoder()
        self._decoder.load(data)
        self._made_for = self._decoder.shown()[1].shape[0]
        self.unit = self._decoder.unit

    @property
    def faces_max(self):
        return self._decoder.faces_held

    def _show(self, faces):
        self._decoder.show(self._made_for if faces is None else _resolution(faces))


def load(path):
    """A StoredMesh of a `.vsplit` file. Raises CorruptError that says at which byte it is damaged, of a newer version or none."""
    return StoredMesh(pathlib.Path(path).read_bytes())


class Mesh(_Shown):
    """Made by Client.improve, control and open; fetches what is missing for a resolution.

    `representation`: the vsplit.v1.Representation at the resolution that it was made for. `max_error`: no coordinate of the stream
    is further from the exact one. `keyframes`, which may be set: a far jump of a "float64" stream may bring the mesh it leads to
    in place of the records between, where that is less to send. What was held before is kept; the resolutions between come when
    they are asked for.
    """

    def __init__(self, client, session, layout):
        """`layout`: a SetResolutionRequest with the encoding of the stream."""
        self._client, self._session, self._layout = client, session, layout
        self._decoder = Decoder()
        self._before = None  # the decoder of what was held before a keyframe
        self._faces_min = 0  # of a keyframe, the coarsest resolution held
        self._keyframe_is_whole = True
        self._begin_stream()
        self.representation = None
        self.max_error = 0.0
        self.keyframes = False

    @property
    def faces_max(self):
        return self.representation.faces_max

    @property
    def unit(self):
        """Of the lengths, "mm" for example; "" where that is not known."""
        return word_of(v1.LengthUnit.DESCRIPTOR, self.representation.unit)

    def figures_at(self, faces):
        """The Representation with the figures of a resolution: quality, whether the bounds of control hold, what breaks them."""
        return self._client._fetch(self, faces, self.representation.id)

    def _show(self, faces):
        wanted = self.representation.faces if faces is None else _resolution(faces)
        if wanted < self._faces_min:
            self._leave_keyframe()
        if wanted > self._decoder.faces_held or not self._decoder.faces_held:
            self._client._fetch(self, wanted, self.representation.id)
        self._decoder.show(wanted)

    def _request(self, representation, faces):
        """Who holds no record yet begins anew: the base mesh or the regions after it may have come in part."""
        if self._before and not self._keyframe_is_whole:
            self._leave_keyframe()
        request = v1.SetResolutionRequest()
        request.CopyFrom(self._layout)
        request.session, request.representation, request.faces = self._session, representation, faces
        request.resume_from = self._decoder.records_held
        request.keyframe = self.keyframes
        return request

    def _leave_keyframe(self):
        self._decoder, self._before, self._faces_min = self._before, None, 0

    def _begin_stream(self):
        self._parts, self._region_parts = [], []

    def _take(self, event):
        """The Representation where the event is one."""
        kind = event.WhichOneof("event")
        if kind in ("representation", "record_block"):
            self._keyframe_is_whole = True  # regions come before
        if kind == "representation":
            return event.representation
        if kind == "base_mesh":
            self._take_base(event.base_mesh)
        elif kind == "regions":
            self._take_regions(event.regions)
        elif kind == "record_block":
            self._decoder.append(event.record_block)
        return None

    def _take_regions(self, part):
        self._region_parts.append(part)
        ids = np.frombuffer(b"".join(p.ids for p in self._region_parts), "<u4")
        if len(ids) > part.faces:
            raise CorruptError(f"regions of {len(ids)} faces came, {part.faces} were announced")
        if len(ids) == part.faces:
            self._decoder.set_regions(ids.astype(np.uint32), self._region_parts[0].sets)
            self._region_parts = []

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
            self._begin(positions, indices, part.ghosts, part.first_record)
        self._parts = []

    def _begin(self, positions, indices, ghosts, first_record):
        """With a keyframe what is held is put by."""
        decoder = Decoder() if first_record else self._decoder
        decoder.begin(positions, indices, ghosts, first_record)
        if not first_record:
            return
        self._before, self._decoder = self._before or self._decoder, decoder
        self._faces_min = decoder.faces_held
        self._keyframe_is_whole = False
