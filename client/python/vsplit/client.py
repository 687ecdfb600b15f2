"""The verbs of the service."""

import os
import pathlib
import time

import grpc

from .access import open_channel
from .mesh import Mesh
from .v1 import meshing_pb2 as v1
from .v1 import meshing_pb2_grpc

_PART = 256 * 1024
_ENCODINGS = {"float64": v1.FLOAT64, "float32": v1.FLOAT32, "quantised": v1.QUANTISED}


class Client:
    """A connection; thread-safe, as grpc channels are. Calls raise grpc.RpcError, whose details say what was wrong."""

    def __init__(self, target, attempts=5, *, token=None, tls_ca=None, tls_cert=None, tls_key=None):
        """`attempts`: tries in a row that bring nothing before a stream that broke is given up.

        `token`: goes with every call; by default that of the variable VSPLIT_TOKEN. `tls_ca`: a file of authorities (PEM), which
        makes it TLS; `tls_cert`, `tls_key`: files to show to a server that wants a certificate.
        """
        options = [("grpc.enable_http_proxy", 0), ("grpc.max_receive_message_length", 64 << 20)]
        self._channel = open_channel(target, options, token or os.environ.get("VSPLIT_TOKEN"), tls_ca, tls_cert, tls_key)
        self._stub = meshing_pb2_grpc.MeshingStub(self._channel)
        self._attempts = attempts

    def close(self):
        self._channel.close()

    def upload(self, mesh, on_progress=None, *, unit="LENGTH_UNIT_UNSPECIFIED"):
        """A new session with a mesh: a path, or the bytes of a file. Returns the session's id.

        `unit`: of its lengths, where the file does not say it, e.g. "MILLIMETRE".
        """
        data = mesh if isinstance(mesh, bytes) else pathlib.Path(mesh).read_bytes()
        session = self._stub.CreateSession(v1.CreateSessionRequest()).id

        def parts():
            for offset in range(0, len(data), _PART):
                part = data[offset:offset + _PART]
                yield v1.UploadMeshRequest(
                    session=session, size=len(data), offset=offset, data=part, unit=v1.LengthUnit.Value(unit))
                if on_progress:
                    on_progress(offset + len(part), len(data))

        self._stub.UploadMesh(parts())
        return session

    def improve(self, session, *, source=None, encoding="float64", bits=0, on_progress=None, **options):
        """A Mesh at the resolution it was made for. `options`: the fields of ImproveOptions; `source`: a Mesh of the session."""
        request = v1.ImproveRequest(session=session, options=v1.ImproveOptions(**options))
        return self._run(self._stub.Improve, request, source, encoding, bits, on_progress)

    def control(self, session, *, source=None, encoding="float64", bits=0, on_progress=None, **options):
        """As improve, with the fields of ControlOptions."""
        request = v1.ControlRequest(session=session, options=v1.ControlOptions(**options))
        return self._run(self._stub.Control, request, source, encoding, bits, on_progress)

    def open(self, session, representation, faces, *, encoding="float64", bits=0):
        """A Mesh of a representation that is there, by its id."""
        mesh = Mesh(self, session, _ENCODINGS[encoding], bits)
        mesh.representation = v1.Representation(id=representation, faces=faces)
        self._fetch(mesh, faces)
        return mesh

    def set_resolution(self, mesh, faces):
        """The same as mesh.at(faces)."""
        return mesh.at(faces)

    def download(self, session, representation="", faces=0, format="STL", unit="LENGTH_UNIT_UNSPECIFIED"):
        """The bytes of a mesh file; its lengths in `unit`, by default the session's."""
        request = v1.DownloadMeshRequest(
            session=session, representation=representation, faces=faces, format=v1.MeshFormat.Value(format),
            unit=v1.LengthUnit.Value(unit))
        return b"".join(chunk.data for chunk in self._stub.DownloadMesh(request))

    def features(self, session, **options):
        """ShapeFeature messages of the session's mesh. `options`: the fields of ListFeaturesRequest."""
        return list(self._stub.ListFeatures(v1.ListFeaturesRequest(session=session, **options)).features)

    def remove_features(self, session, *, ids=(), **options):
        """Takes features off the session's mesh; a RemoveFeaturesResponse. `options`: `max_diameter`, `kinds`, `angle`."""
        return self._stub.RemoveFeatures(v1.RemoveFeaturesRequest(session=session, ids=ids, **options))

    def keep_alive(self, session):
        """Puts off when the session expires; a Session, which says until when."""
        return self._stub.KeepAlive(v1.KeepAliveRequest(session=session))

    def delete(self, session):
        self._stub.DeleteSession(v1.DeleteSessionRequest(session=session))

    def _run(self, method, request, source, encoding, bits, on_progress):
        mesh = Mesh(self, request.session, _ENCODINGS[encoding], bits)
        request.encoding, request.quantisation_bits = mesh._encoding, bits
        if source is not None:
            request.source.representation, request.source.faces = source.representation.id, source.representation.faces
        for event in method(request):
            if on_progress and event.WhichOneof("event") == "progress":
                on_progress(event.progress)
            mesh._take(event)
        return mesh

    def _fetch(self, mesh, faces):
        """Records up to a resolution; a stream that breaks goes on where it broke."""
        failed = 0
        while True:
            held = (mesh._decoder.faces_held, mesh._decoder.records_held)
            try:
                mesh._parts = []
                for event in self._stub.SetResolution(self._request(mesh, faces)):
                    mesh._take(event)
                return
            except grpc.RpcError as error:
                if error.code() != grpc.StatusCode.UNAVAILABLE:
                    raise
                brought = held != (mesh._decoder.faces_held, mesh._decoder.records_held)
                failed = 0 if brought else failed + 1
                if failed >= self._attempts:
                    raise
                time.sleep(min(0.02 * 2**failed, 2))

    @staticmethod
    def _request(mesh, faces):
        held = mesh._decoder.records_held
        return v1.SetResolutionRequest(
            session=mesh._session, representation=mesh.representation.id, faces=faces, encoding=mesh._encoding,
            quantisation_bits=mesh._bits, resume_from=held, faces_held=0 if held else mesh._decoder.faces_held)
