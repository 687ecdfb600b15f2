"""The verbs of the service."""

import contextlib
import os
import pathlib
import time

import grpc

from .access import open_channel
from .mesh import Mesh
from .mesh_file import MeshFile
from .v1 import meshing_pb2 as v1
from .v1 import meshing_pb2_grpc
from .words import message_of

_PART = 256 * 1024


class Client:
    """A connection; thread-safe, as grpc channels are. `with` closes it.

    Formats, units, repairs and whatever else has a name are given by the words of the command line ("inp", "mm", "full") or by the
    names of the contract ("INP", "MILLIMETRE", "FULL"). A word that stands for nothing, and an option that there is not, is a
    ValueError that lists what is accepted, before anything is sent. Calls raise grpc.RpcError, whose details() say what was wrong;
    vsplit.problem_of(error) has the cause and the field.

    A `representation` is the id of one, or its Mesh; without one the upload is meant. `faces` is its resolution, 0 the one that it
    was made for.
    """

    def __init__(self, target, attempts=5, *, token=None, tls_ca=None, tls_cert=None, tls_key=None):
        """`attempts`: tries in a row that bring nothing before a stream that broke is given up.

        `token`: goes with every call; by default that of the variable VSPLIT_TOKEN. `tls_ca`: a file of authorities (PEM), which
        makes it TLS; `tls_cert`, `tls_key`: files to show to a server that wants a certificate.
        """
        options = [("grpc.enable_http_proxy", 0), ("grpc.max_receive_message_length", 64 << 20)]
        self._channel = open_channel(target, options, token or os.environ.get("VSPLIT_TOKEN"), tls_ca, tls_cert, tls_key)
        self._stub = meshing_pb2_grpc.MeshingStub(self._channel)
        self._attempts = attempts

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        self._channel.close()

    def upload(self, mesh, on_progress=None, *, session=None, format=None, weld=0.0, repair=None, unit=None,
               stitch=None, hole_size=None, speck_size=None):
        """A session with a mesh: a path, or the bytes of a file. Returns the session's id.

        `session`: whose mesh it takes the place of; by default a new one, which is deleted where the mesh is refused. `format`: by
        default told from the bytes. `weld`: vertices within this distance are merged, by default equal ones. `repair`: "none" (the
        findings say what stands in the way), "safe" or "full" (docs/repair.md). `unit`: of the lengths, where the file does not say
        it. With repair "full": `stitch`, borders this close are joined; `hole_size`, holes with a box of at most this diagonal are
        filled; `speck_size`, pieces with a box of a smaller diagonal are dropped; lengths, by default 0.2, 5 and 0.1 % of the
        diagonal of the mesh's box. What was found, and what a repair changed: client.session(id).source.findings. `on_progress(sent, size)`: in bytes.
        """
        data = mesh if isinstance(mesh, (bytes, bytearray, memoryview)) else pathlib.Path(mesh).read_bytes()
        first = message_of(
            v1.UploadMeshRequest,
            {"format": format, "weld": weld, "repair": repair, "unit": unit, "stitch": stitch, "hole_size": hole_size,
             "speck_size": speck_size, "size": memoryview(data).nbytes})
        first.session = session or self._stub.CreateSession(v1.CreateSessionRequest()).id
        try:
            self._send(first, bytes(data), on_progress)
        except BaseException:
            if not session:
                with contextlib.suppress(grpc.RpcError):
                    self.delete(first.session)
            raise
        return first.session

    def session(self, session):
        """A Session message: the mesh's summary with its findings (`source`), representations, when it expires."""
        return self._stub.GetSession(v1.GetSessionRequest(session=session))

    def sessions(self):
        """Session messages of all sessions, in order of creation."""
        found, page = [], None
        while page is None or page.next_page_token:
            page = self._stub.ListSessions(v1.ListSessionsRequest(page_token=page.next_page_token if page else ""))
            found.extend(page.sessions)
        return found

    def keep_alive(self, session):
        """Puts off when the session expires; a Session, which says until when."""
        return self._stub.KeepAlive(v1.KeepAliveRequest(session=session))

    def delete(self, session):
        self._stub.DeleteSession(v1.DeleteSessionRequest(session=session))

    def improve(self, session, *, source=None, source_faces=0, encoding="float64", bits=0, on_progress=None, timeout=None,
                **options):
        """A Mesh at the resolution it was made for.

        `options`: the fields of ImproveOptions; `regions`, `marked_edges` and `sizing` take arrays, and a dict such as
        {"spheres": [{"center": (0, 0, 0), "radius": 5, "size": 1}], "gradation": 0.2}. `source`: the representation to start from,
        at the resolution `source_faces`. `encoding`: of the stream, "float64", "float32" or "quantised" to a grid of `bits`.
        `timeout`: seconds for all of it, the wait for methods before it included; by default no end.
        """
        request = v1.ImproveRequest(session=session, options=message_of(v1.ImproveOptions, options))
        return self._run(self._stub.Improve, request, (source, source_faces), encoding, bits, on_progress, timeout)

    def control(self, session, *, source=None, source_faces=0, encoding="float64", bits=0, on_progress=None, timeout=None,
                **options):
        """As improve, with the fields of ControlOptions."""
        request = v1.ControlRequest(session=session, options=message_of(v1.ControlOptions, options))
        return self._run(self._stub.Control, request, (source, source_faces), encoding, bits, on_progress, timeout)

    def open(self, session, representation="", faces=None, *, encoding="float64", bits=0, keyframes=False):
        """A Mesh of a representation that is there, by default the session's newest, at the resolution `faces`, by default the one
        that it was made for. `keyframes`: as Mesh has it."""
        held = self.session(session).representations
        made = next((each for each in held[::-1] if representation in ("", each.id)), None)
        mesh = Mesh(self, session, message_of(v1.SetResolutionRequest, {"encoding": encoding, "quantisation_bits": bits}))
        mesh.keyframes = keyframes
        wanted = made.faces if made and faces is None else faces or 0
        mesh.representation = self._fetch(mesh, wanted, made.id if made else representation)
        return mesh

    def set_resolution(self, mesh, faces):
        """The same as mesh.at(faces)."""
        return mesh.at(faces)

    def download(self, session, representation="", faces=0, format="stl", unit=None, order=None):
        """A MeshFile: the bytes of a mesh file, with what the server says of it; its lengths in `unit`, by default the session's.

        `order`: 1, triangles of three nodes, or 2, of six, the middle ones on the upload's surface ("msh", "inp", "bdf", "vtk" and
        "vtu").
        """
        representation, faces = _place_of(representation, faces)
        fields = {"representation": representation, "faces": faces, "format": format, "unit": unit, "order": order}
        request = message_of(v1.DownloadMeshRequest, {"session": session, **fields})
        return MeshFile.of_chunks(self._stub.DownloadMesh(request))

    def quality(self, session, representation="", faces=0, *, worst=0, profile=None):
        """A Quality message: counts, stretch with its histogram, sizes, and the worst faces, `worst` of them, 0 for 20.

        `profile`: "stretch-02", "verdict" or "optistruct", by whose limits faces pass, are warned of or fail (`profile` of the
        answer).
        """
        representation, faces = _place_of(representation, faces)
        fields = {"representation": representation, "faces": faces, "worst": worst, "profile": profile}
        return self._stub.GetQuality(message_of(v1.GetQualityRequest, {"session": session, **fields}))

    def features(self, session, **options):
        """ShapeFeature messages of the session's mesh. `options`: `angle`."""
        return list(self._stub.ListFeatures(message_of(v1.ListFeaturesRequest, {"session": session, **options})).features)

    def remove_features(self, session, *, ids=(), **options):
        """Takes features off the session's mesh; a RemoveFeaturesResponse.

        `options`: `max_diameter`, `kinds` ("through-hole", "blind-hole", "boss", "fillet"), `angle`.
        """
        return self._stub.RemoveFeatures(message_of(v1.RemoveFeaturesRequest, {"session": session, "ids": ids, **options}))

    def _send(self, first, data, on_progress):
        failures = []

        def parts():
            try:
                part = first
                for offset in range(0, max(len(data), 1), _PART):
                    part.offset, part.data = offset, data[offset:offset + _PART]
                    yield part
                    if on_progress:
                        on_progress(offset + len(part.data), len(data))
                    part = v1.UploadMeshRequest()
            except Exception as failure:  # grpc would tell of "Exception iterating requests!"
                failures.append(failure)
                raise

        try:
            return self._stub.UploadMesh(parts())
        except grpc.RpcError:
            if failures:
                raise failures[0] from None
            raise

    def _run(self, method, request, source, encoding, bits, on_progress, timeout):
        layout = message_of(v1.SetResolutionRequest, {"encoding": encoding, "quantisation_bits": bits})
        mesh = Mesh(self, request.session, layout)
        request.encoding, request.quantisation_bits = layout.encoding, bits
        request.source.representation, request.source.faces = _place_of(*source)
        for event in method(request, timeout=timeout):
            if on_progress and event.WhichOneof("event") == "progress":
                on_progress(event.progress)
            mesh.representation = mesh._take(event) or mesh.representation
        return mesh

    def _fetch(self, mesh, faces, representation):
        """Brings records up to a resolution; a stream that breaks goes on where it broke. The Representation at that resolution."""
        failed = 0
        while True:
            held = mesh._decoder.records_held
            try:
                made = None
                mesh._begin_stream()
                for event in self._stub.SetResolution(mesh._request(representation, faces)):
                    made = mesh._take(event) or made
                return made
            except grpc.RpcError as error:
                if error.code() != grpc.StatusCode.UNAVAILABLE:
                    raise
                failed = 0 if held != mesh._decoder.records_held else failed + 1
                if failed >= self._attempts:
                    raise
                time.sleep(min(0.02 * 2**failed, 2))


def _place_of(representation, faces):
    """Id and resolution; those of a Mesh are what it was made for."""
    if isinstance(representation, Mesh):
        return representation.representation.id, faces or representation.representation.faces
    return representation or "", faces or 0
