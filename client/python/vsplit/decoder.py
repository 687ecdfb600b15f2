"""The C++ decoder, by ctypes."""

import ctypes
import pathlib

import numpy as np

_U32 = ctypes.c_uint32
_BYTES = ctypes.c_char_p


class CorruptError(Exception):
    """What came from the server, or a file, is damaged, or does not fit what came before."""


def _load():
    file = pathlib.Path(__file__).with_name("libvsplit_decoder.so")
    try:
        library = ctypes.CDLL(str(file))
    except OSError as error:
        raise ImportError(f"{file} is missing or not for this machine: use the package that the build makes, "
                          "BUILD/python, or the installed one, not the sources") from error
    pointer = ctypes.c_void_p
    doubles = np.ctypeslib.ndpointer(np.float64, flags="C_CONTIGUOUS")
    indices = np.ctypeslib.ndpointer(np.uint32, flags="C_CONTIGUOUS")
    for name, result, arguments in (
        ("new", pointer, []),
        ("free", None, [pointer]),
        ("error", _BYTES, [pointer]),
        ("begin_keyframe", ctypes.c_int, [pointer, doubles, _U32, indices, _U32, _U32, _U32]),
        ("begin_packed", ctypes.c_int,
         [pointer, _BYTES, ctypes.c_size_t, _U32, _U32, _U32, _U32, _U32, _U32, ctypes.c_double * 3, ctypes.c_double]),
        ("load", ctypes.c_int, [pointer, _BYTES, ctypes.c_size_t]),
        ("set_regions", ctypes.c_int, [pointer, indices, _U32]),
        ("add_set", ctypes.c_int, [pointer, _BYTES, indices, _U32]),
        ("append", ctypes.c_int, [pointer, _U32, _U32, _U32, _U32, _BYTES, ctypes.c_size_t]),
        ("show", ctypes.c_int, [pointer, _U32]),
        ("faces_held", _U32, [pointer]),
        ("records_held", _U32, [pointer]),
        ("vertices", _U32, [pointer]),
        ("faces", _U32, [pointer]),
        ("copy", None, [pointer, doubles, indices]),
        ("has_regions", ctypes.c_int, [pointer]),
        ("copy_regions", None, [pointer, indices]),
        ("sets", _U32, [pointer]),
        ("set_name", _BYTES, [pointer, _U32]),
        ("set_size", _U32, [pointer, _U32]),
        ("copy_set", None, [pointer, _U32, indices]),
        ("unit", _BYTES, [pointer]),
    ):
        function = getattr(library, "vsplit_decoder_" + name)
        function.restype, function.argtypes = result, arguments
    return library


_library = _load()


class Decoder:
    """Holds what a stream brought. Not thread-safe."""

    def __init__(self):
        self._decoder = _library.vsplit_decoder_new()
        if not self._decoder:
            raise MemoryError()

    def __del__(self):
        if getattr(self, "_decoder", None):
            _library.vsplit_decoder_free(self._decoder)

    def _check(self, failed):
        if failed:
            raise CorruptError(_library.vsplit_decoder_error(self._decoder).decode())

    def begin(self, positions, indices, ghosts, first_record=0):
        """`first_record`: of a keyframe, the first record that it has not in it yet."""
        self._check(_library.vsplit_decoder_begin_keyframe(
            self._decoder, positions, len(positions), indices, len(indices), ghosts, first_record))

    def begin_packed(self, packed, part):
        """`part`: any BaseMesh message of the stream."""
        origin = (ctypes.c_double * 3)(part.origin.x, part.origin.y, part.origin.z)
        self._check(_library.vsplit_decoder_begin_packed(
            self._decoder, packed, len(packed), part.packed_crc32c, part.vertices, part.faces, part.ghosts, part.encoding,
            part.quantisation_bits, origin, part.step))

    def load(self, data):
        self._check(_library.vsplit_decoder_load(self._decoder, data, len(data)))

    def set_regions(self, ids, sets):
        """`ids`: of every face of the finest mesh; `sets`: FaceSet messages."""
        self._check(_library.vsplit_decoder_set_regions(self._decoder, ids, len(ids)))
        for each in sets:
            regions = np.array(each.regions, np.uint32)
            self._check(_library.vsplit_decoder_add_set(self._decoder, each.name.encode(), regions, len(regions)))

    def append(self, block):
        self._check(_library.vsplit_decoder_append(
            self._decoder, block.first, block.count, block.encoding, block.crc32c, block.payload, len(block.payload)))

    def show(self, faces):
        self._check(_library.vsplit_decoder_show(self._decoder, faces))

    @property
    def faces_held(self):
        return _library.vsplit_decoder_faces_held(self._decoder)

    @property
    def records_held(self):
        return _library.vsplit_decoder_records_held(self._decoder)

    def shown(self):
        points = np.empty((_library.vsplit_decoder_vertices(self._decoder), 3), np.float64)
        faces = np.empty((_library.vsplit_decoder_faces(self._decoder), 3), np.uint32)
        _library.vsplit_decoder_copy(self._decoder, points, faces)
        return points, faces

    def shown_regions(self):
        """None where the mesh has none."""
        if not _library.vsplit_decoder_has_regions(self._decoder):
            return None
        ids = np.empty(_library.vsplit_decoder_faces(self._decoder), np.uint32)
        _library.vsplit_decoder_copy_regions(self._decoder, ids)
        return ids

    def sets(self):
        """Pairs of a name and the regions it stands for."""
        found = []
        for number in range(_library.vsplit_decoder_sets(self._decoder)):
            regions = np.empty(_library.vsplit_decoder_set_size(self._decoder, number), np.uint32)
            _library.vsplit_decoder_copy_set(self._decoder, number, regions)
            found.append((_library.vsplit_decoder_set_name(self._decoder, number).decode(errors="replace"), regions))
        return found

    @property
    def unit(self):
        return _library.vsplit_decoder_unit(self._decoder).decode()
