"""The Python client against a server of its own: client_test.py VSPLITD VSPLIT."""

import hashlib
import importlib
import itertools
import pathlib
import subprocess
import sys
import tempfile
import unittest

import grpc
import numpy as np

import vsplit
from vsplit.v1 import meshing_pb2 as v1

DATA = pathlib.Path(__file__).parent.parent / "data"


def read_ply_regions(data):
    """As vsplit writes it: little-endian, doubles, and the regions where there are any."""
    head, body = data.split(b"end_header\n", 1)
    counts = {line.split()[1]: int(line.split()[2]) for line in head.decode().splitlines() if line.startswith("element")}
    size = counts["vertex"] * 24
    points = np.frombuffer(body[:size], "<f8").reshape(-1, 3)
    row = [("n", "u1"), ("v", "<u4", 3)] + [("region", "<u4")] * (b"property uint region" in head)
    faces = np.frombuffer(body[size:], np.dtype(row))
    return points, faces["v"], faces["region"] if len(row) == 3 else None


def read_ply(data):
    return read_ply_regions(data)[:2]


def box_obj(sides=6, steps=6):
    """A cube of edge 1 as OBJ, a group a side; open where `sides` is less than 6."""
    numbers, faces = {}, []
    for side in range(sides):
        axis, far = divmod(side, 2)
        faces.append(f"g side{side}")
        for i in range(steps):
            for j in range(steps):
                corners = []
                for a, b in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)):
                    point = [0, 0, 0]
                    point[axis], point[(axis + 1) % 3], point[(axis + 2) % 3] = far * steps, a, b
                    corners.append(numbers.setdefault(tuple(point), len(numbers) + 1))
                for face in (corners[:3], [corners[0], *corners[2:]]):
                    faces.append("f " + " ".join(map(str, face if far else face[::-1])))
    points = [f"v {x / steps} {y / steps} {z / steps}" for x, y, z in numbers]
    return "\n".join([*points, *faces, ""]).encode()


# A tetrahedron with one face twice, and one whose vertices miss each other.
DIRTY = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\nf 1 4 3\n"
GAPING = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 0 1.001\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 5 3\n"


class Cut(grpc.RpcError):
    """A connection that broke."""

    def code(self):
        return grpc.StatusCode.UNAVAILABLE


def cut_after(stream, kind, times):
    """The rpc `stream`, which breaks the first `times` times after its first event of `kind`."""

    def call(request):
        nonlocal times
        for event in stream(request):
            yield event
            if times and event.WhichOneof("event") == kind:
                times -= 1
                raise Cut()

    return call


def cut_before(stream, kind, times):
    """The same, which breaks in place of that event."""

    def call(request):
        nonlocal times
        for event in stream(request):
            if times and event.WhichOneof("event") == kind:
                times -= 1
                raise Cut()
            yield event

    return call


def damaged_base(stream):
    """The rpc `stream`, with a bit of its packed base mesh turned."""

    def call(request):
        for event in stream(request):
            if event.base_mesh.packed:
                packed = bytearray(event.base_mesh.packed)
                packed[-3] ^= 1
                event.base_mesh.packed = bytes(packed)
            yield event

    return call


class Counted:
    """The rpc `stream`, with the bytes that it brought and the keyframes among them."""

    def __init__(self, stream):
        self._stream, self.bytes, self.keyframes = stream, 0, 0

    def __call__(self, request):
        keyframe = False
        for event in self._stream(request):
            self.bytes += event.ByteSize()
            self.keyframes += event.base_mesh.first_record != 0 and not keyframe  # it comes in parts
            keyframe |= event.base_mesh.first_record != 0
            yield event


class ClientTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.server = subprocess.Popen([sys.argv[1], "--listen", "127.0.0.1:0", "--http", "off"], stdout=subprocess.PIPE, text=True)
        line = cls.server.stdout.readline()
        cls.address = "127.0.0.1:" + line.rsplit(":", 1)[1].split()[0].strip().rstrip(".")
        cls.client = vsplit.Client(cls.address)
        cls.session = cls.client.upload(DATA / "bracket.stl")

    @classmethod
    def tearDownClass(cls):
        cls.client.close()
        cls.server.terminate()
        cls.server.wait(20)

    def installed(self, module):
        try:
            return importlib.import_module(module)
        except ImportError:
            self.skipTest(module + " is not installed")

    def test_any_resolution_is_what_download_gives(self):
        for encoding, bits in (("float64", 0), ("float32", 0), ("quantised", 12)):
            mesh = self.client.improve(self.session, encoding=encoding, bits=bits, faces=3000)
            made = mesh.representation
            self.assertGreater(made.faces_max, made.faces)
            for faces in (made.faces, made.faces_min, made.faces_max, (made.faces + made.faces_min) // 2):
                points, triangles = mesh.at(faces)
                exact, expected = read_ply(self.client.download(self.session, made.id, faces, "PLY"))
                np.testing.assert_array_equal(triangles, expected)
                if encoding == "float64":
                    np.testing.assert_array_equal(points, exact)
                elif encoding == "float32":
                    np.testing.assert_array_equal(points, exact.astype(np.float32).astype(np.float64))
                else:
                    self.assertGreater(mesh.max_error, 0)
                    self.assertLessEqual(np.abs(points - exact).max(), mesh.max_error)
            again = self.client.open(self.session, made.id, made.faces_min, encoding=encoding, bits=bits)
            np.testing.assert_array_equal(again.at(made.faces)[0], mesh.at(made.faces)[0])

    def test_holes_are_listed_and_removed(self):
        session = self.client.upload(DATA / "bracket.stl")
        holes = self.client.features(session)
        of_kind = [v1.ShapeFeature.THROUGH_HOLE, v1.ShapeFeature.BLIND_HOLE]
        small = [hole.id for hole in holes if hole.diameter < 7 and hole.kind in of_kind]
        self.assertEqual(len(small), 6)
        done = self.client.remove_features(session, ids=small[:2], max_diameter=6.5, kinds=of_kind)
        self.assertEqual(list(done.removed), small)
        self.assertTrue(done.source.closed)
        self.assertEqual(len(self.client.features(session)), len(holes) - 6)
        self.client.delete(session)

    def test_units_are_stated_and_converted(self):
        session = self.client.upload(DATA / "bracket.stl", unit="INCH")
        inches, _ = read_ply(self.client.download(session, format="PLY"))
        millimetres, _ = read_ply(self.client.download(session, format="PLY", unit="MILLIMETRE"))
        np.testing.assert_array_equal(millimetres, inches * 127 / 5)
        with self.assertRaises(grpc.RpcError) as refused:
            self.client.download(self.session, unit="METRE")
        self.assertIn("not known", refused.exception.details())
        self.client.delete(session)

    def test_words_of_the_command_line_and_of_the_contract_are_taken(self):
        written = (("in", "none", "obj"), ("INCH", "NONE", "OBJ"), ("Inch", "None", "Obj"), (v1.INCH, v1.NONE, v1.OBJ))
        for unit, repair, format in written:
            session = self.client.upload(box_obj(), unit=unit, repair=repair, format=format)
            self.assertEqual(self.client.session(session).source.unit, v1.INCH)
            self.assertTrue(self.client.download(session, format="inp").startswith(b"*"))
            self.assertEqual(self.client.download(session, format="3mf"), self.client.download(session, format="THREE_MF"))
            points, _ = read_ply(self.client.download(session, format="ply", unit="mm"))
            self.assertEqual(points.max(), 25.4)
            made = self.client.improve(
                session, mode="strict", feature_detection="normal-voting", subdivision_size=0.1).representation
            self.assertEqual(made.mode, v1.STRICT)
            self.assertEqual(made.improve_options.feature_detection, v1.NORMAL_VOTING)
            self.client.delete(session)

    def test_other_words_and_options_are_refused_before_the_call(self):
        nobody = vsplit.Client("127.0.0.1:1")  # a call would be an RpcError
        for call, listed in (
            (lambda: nobody.upload(b"x", unit="furlong"), "unit: 'furlong' is none of um, mm, cm, m, in, ft"),
            (lambda: nobody.upload(b"x", unit=7), "unit: 7 is none of um"),
            (lambda: nobody.upload(b"x", unit=""), "unit: '' is none of um"),
            (lambda: nobody.upload(b"x", repair=True), "repair: True is none of none, safe, full"),
            (lambda: nobody.upload(b"x", format="step"), "format: 'step' .*, 3mf, nor of the names STL, .*THREE_MF"),
            (lambda: nobody.download("s", format="xyz"), "format: 'xyz' is none of stl, stl-ascii"),
            (lambda: nobody.download("s", unit="parsec"), "unit: 'parsec' is none of"),
            (lambda: nobody.quality("s", profile="nastran"), "profile: 'nastran' is none of stretch-02, verdict, optistruct"),
            (lambda: nobody.improve("s", encoding="zip"), "encoding: 'zip' is none of float64, float32, quantised"),
            (lambda: nobody.improve("s", mode="fast"), "mode: 'fast' is none of strict, extended"),
            (lambda: nobody.improve("s", tol=1), "tol: .* ImproveOptions are subdivision_size, tolerance"),
            (lambda: nobody.control("s", sizing={"spheres": [{"raduis": 1}]}),
             r"sizing.spheres\[0\].raduis: .* center, radius, size"),
            (lambda: nobody.remove_features("s", kinds=["hole"]), "kinds: 'hole' is none of through-hole"),
            (lambda: nobody.features("s", angel=3), "angel: .* angle"),
        ):
            with self.assertRaisesRegex(ValueError, listed):
                call()
        with self.assertRaisesRegex(TypeError, "faces: 'many'"):
            nobody.improve("s", faces="many")
        with self.assertRaisesRegex(TypeError, r"sizing.boxes\[0\].min: \(1, 2\)"):
            nobody.improve("s", sizing={"boxes": [{"min": (1, 2)}]})

    def test_a_dirty_mesh_is_repaired_and_what_changed_is_told(self):
        session = self.client.upload(DIRTY, repair="none")
        self.assertFalse(self.client.session(session).source.closed)
        self.assertEqual(self.client.upload(DIRTY, session=session, repair="safe"), session)
        source = self.client.session(session).source
        self.assertTrue(source.closed)
        self.assertEqual(source.faces, 4)
        self.assertIn(("DROPPED_DUPLICATE", 1), [(finding.kind, finding.count) for finding in source.findings])
        self.assertFalse(self.client.session(self.client.upload(GAPING, session=session, weld=1e-4)).source.closed)
        with self.assertRaisesRegex(grpc.RpcError, "stitch is given; it is accepted with the repair FULL alone"):
            self.client.upload(DIRTY, repair="safe", stitch=0.1)
        self.assertTrue(self.client.session(self.client.upload(GAPING, session=session, weld=0.01)).source.closed)
        self.client.delete(session)

    def test_an_upload_that_fails_leaves_no_session(self):
        before = {session.id for session in self.client.sessions()}
        for bad in (b"", b"not a mesh"):
            with self.assertRaises(grpc.RpcError):
                self.client.upload(bad)
        with self.assertRaises(FileNotFoundError):
            self.client.upload(DATA / "none.stl")
        with self.assertRaisesRegex(KeyError, "of the caller"):  # not "Exception iterating requests!"
            self.client.upload(DIRTY, lambda sent, size: {}["of the caller"])
        self.assertEqual({session.id for session in self.client.sessions()}, before)

    def test_progress_of_an_upload_is_told(self):
        steps = []
        size = (DATA / "bracket.stl").stat().st_size
        self.client.delete(self.client.upload(DATA / "bracket.stl", lambda *step: steps.append(step)))
        self.assertEqual([total for _, total in steps], [size] * -(-size // (256 * 1024)))
        self.assertEqual(steps[-1][0], size)

    def test_quality_is_that_of_a_resolution_and_a_profile(self):
        mesh = self.client.improve(self.session, faces=3000)
        made = mesh.representation
        self.assertEqual(self.client.quality(self.session).faces, self.client.session(self.session).source.faces)
        quality = self.client.quality(self.session, mesh, profile="optistruct", worst=7)
        self.assertEqual(quality.faces, made.faces)
        self.assertEqual(len(quality.worst_faces), 7)
        self.assertEqual(quality.profile.profile, v1.OPTISTRUCT)
        self.assertEqual(quality.profile.passed + quality.profile.warned + quality.profile.failed, made.faces)
        finest = self.client.quality(self.session, made.id, made.faces_max)
        self.assertEqual(finest.faces, made.faces_max)
        self.assertEqual(len(finest.worst_faces), 20)
        self.assertFalse(finest.HasField("profile"))

    def test_elements_of_second_order(self):
        mesh = self.client.improve(self.session, faces=3000)
        for order, kind in ((None, b"S3"), (1, b"S3"), (2, b"S6")):
            file = self.client.download(self.session, mesh, format="inp", order=order)
            self.assertIn(b"TYPE=" + kind, file)
            self.assertEqual(file.faces, mesh.representation.faces)
            self.assertEqual(file.digest, hashlib.sha256(file).hexdigest())
            self.assertTrue(file.name.endswith(".inp"))
        with self.assertRaises(grpc.RpcError) as refused:
            self.client.download(self.session, mesh, format="stl", order=2)
        self.assertEqual(vsplit.problem_of(refused.exception).field, "order")

    def test_regions_and_sets_are_those_of_downloads_at_any_resolution(self):
        for sides in (6, 5):  # closed, and with a ghost
            session = self.client.upload(box_obj(sides), unit="mm")
            for encoding, bits in (("float64", 0), ("quantised", 14)):
                mesh = self.client.improve(
                    session, faces=500, subdivision_size=0.1, min_mean_stretch=0, encoding=encoding, bits=bits)
                made = mesh.representation
                self.assertLess(made.faces_min, 300)
                self.assertEqual(list(mesh.sets), [f"side{side}" for side in range(sides)])
                for faces in (None, made.faces_min, 300, made.faces_max):
                    self.check_regions(mesh, session, faces, sides)
                again = self.client.open(session, encoding=encoding, bits=bits)
                np.testing.assert_array_equal(again.regions_at(), mesh.regions_at())
            self.client.delete(session)
        self.assertIsNone(self.client.improve(self.session, faces=3000).regions_at())

    def check_regions(self, mesh, session, faces, sides):
        points, triangles = mesh.at(faces)
        regions = mesh.regions_at(faces)
        _, expected, expected_regions = read_ply_regions(self.client.download(session, mesh, faces or 0, "ply"))
        np.testing.assert_array_equal(triangles, expected)
        np.testing.assert_array_equal(regions, expected_regions)
        of_sets = mesh.sets_at(faces)
        self.assertEqual(sum(map(len, of_sets.values())), len(triangles))
        for side, members in enumerate(of_sets.values()):
            axis, far = divmod(side, 2)
            np.testing.assert_allclose(points[triangles[members], axis], far, atol=0.01)

    def test_regions_of_the_options_are_taken_as_an_array(self):
        _, faces = read_ply(self.client.download(self.session, format="ply"))
        regions = np.arange(len(faces)) % 2 + 5
        mesh = self.client.improve(self.session, faces=3000, regions=regions.astype(np.uint32), marked_edges=faces[:2, :2])
        self.assertEqual(set(mesh.regions_at().tolist()), {5, 6})
        self.assertEqual(mesh.sets, {})
        with self.assertRaisesRegex(TypeError, "regions: "):
            self.client.improve(self.session, regions=regions + 0.5)

    def test_sizes_vary_where_a_dict_says_so(self):
        session = self.client.upload(box_obj())
        ball = {"center": np.zeros(3), "radius": 0.3, "size": 0.03}
        self.assertLessEqual(self.longest_near(session, sizing={"spheres": [ball], "gradation": 0.5}), 0.03)
        self.assertGreater(self.longest_near(session), 0.03)
        self.client.delete(session)

    def longest_near(self, session, **options):
        """Longest edge of the faces within 0.3 of the origin."""
        points, triangles = self.client.improve(session, **options).at()
        corners = points[triangles]
        near = np.linalg.norm(corners, axis=2).max(axis=1) < 0.3
        return np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2)[near].max()

    def test_a_stream_that_breaks_is_taken_up_with_its_regions(self):
        session = self.client.upload(box_obj(5))
        whole = self.client.improve(session, faces=500, subdivision_size=0.1)
        made = whole.representation
        stream = self.client._stub.SetResolution
        try:
            for kind in ("base_mesh", "regions", "record_block"):
                for encoding in ("float64", "float32"):
                    self.client._stub.SetResolution = cut_after(stream, kind, 2)
                    mesh = self.client.open(session, made.id, made.faces_max, encoding=encoding)
                    np.testing.assert_array_equal(mesh.at(made.faces_max)[1], whole.at(made.faces_max)[1])
                    np.testing.assert_array_equal(mesh.regions_at(made.faces_max), whole.regions_at(made.faces_max))
                    self.assertEqual(list(mesh.sets), list(whole.sets))
            self.client._stub.SetResolution = cut_after(stream, "regions", 100)
            with self.assertRaises(Cut):
                self.client.open(session, made.id)
        finally:
            self.client._stub.SetResolution = stream
        self.client.delete(session)

    def test_a_damaged_base_mesh_is_refused(self):
        made = self.client.improve(self.session, faces=500).representation
        stream = self.client._stub.SetResolution
        self.client._stub.SetResolution = damaged_base(stream)
        try:
            with self.assertRaisesRegex(vsplit.CorruptError, "base mesh: its CRC-32C does not fit"):
                self.client.open(self.session, made.id, encoding="quantised", bits=14)
        finally:
            self.client._stub.SetResolution = stream

    def test_no_resolution_is_refused_and_nothing_is_lost(self):
        improved = self.client.improve(self.session, faces=500)
        for shown in (improved, vsplit.load(DATA / "golden" / "file_1_closed.vsplit")):
            before = shown.at(np.uint32(400))
            for faces in (-1, 0, 2**32 + 400):
                with self.assertRaisesRegex(ValueError, f"faces is {faces}; accepted is"):
                    shown.at(faces)
            with self.assertRaises(TypeError):
                shown.at(400.5)
            np.testing.assert_array_equal(shown.at(400)[1], before[1])

    def test_a_far_jump_takes_a_keyframe_where_that_is_less_to_receive(self):
        session = self.client.upload(box_obj(5))  # with a ghost and regions
        made = self.client.improve(session, faces=500, subdivision_size=0.03).representation
        self.assertGreater(made.faces_max, 4 * made.faces_min)
        stream = self.client._stub.SetResolution
        received = {}
        try:
            for keyframes in (False, True):
                self.client._stub.SetResolution = counted = Counted(stream)
                mesh = self.client.open(session, made.id, made.faces_max, keyframes=keyframes)
                received[keyframes] = counted.bytes
                self.assertEqual(counted.keyframes, keyframes)
                self.check_is_what_download_gives(mesh, session, made.faces_max)
            self.assertLess(received[True], 0.8 * received[False])

            # A jump up keeps what was there; what lies between comes when it is asked for, and goes on in records.
            self.client._stub.SetResolution = counted = Counted(stream)
            mesh = self.client.open(session, made.id, made.faces_min, keyframes=True)
            far = made.faces_max - 400
            self.check_is_what_download_gives(mesh, session, far)
            self.assertEqual(counted.keyframes, 1)
            self.check_is_what_download_gives(mesh, session, made.faces_max)
            self.assertEqual(counted.keyframes, 1)
            before = counted.bytes
            for faces in (far, made.faces_max, made.faces_max - 200, made.faces_min):
                self.check_is_what_download_gives(mesh, session, faces)
            self.assertEqual(counted.bytes, before)
            self.check_is_what_download_gives(mesh, session, made.faces_min + 50)
            self.assertGreater(counted.bytes, before)

            # One that breaks before its regions came is left; the figures of a coarser resolution leave nothing.
            self.client._stub.SetResolution = cut_before(stream, "regions", 2)
            mesh = self.client.open(session, made.id, made.faces_max, keyframes=True)
            self.assertEqual(mesh.figures_at(made.faces_min).faces, made.faces_min)
            self.check_is_what_download_gives(mesh, session, made.faces_max)
        finally:
            self.client._stub.SetResolution = stream
        quantised = self.client.open(session, made.id, made.faces_max, encoding="quantised", bits=14, keyframes=True)
        np.testing.assert_array_equal(quantised.at(made.faces_min)[1], mesh.at(made.faces_min)[1])
        self.client.delete(session)

    def check_is_what_download_gives(self, mesh, session, faces):
        points, triangles, regions = read_ply_regions(self.client.download(session, mesh, faces, "ply"))
        got = mesh.at(faces)
        np.testing.assert_array_equal(got[0], points)
        np.testing.assert_array_equal(got[1], triangles)
        np.testing.assert_array_equal(mesh.regions_at(faces), regions)

    def test_files_have_regions_sets_and_a_unit(self):
        with tempfile.TemporaryDirectory() as folder:
            for sides in (6, 5):
                source, file, ply = (pathlib.Path(folder) / name for name in ("box.obj", "box.vsplit", "box.ply"))
                source.write_bytes(box_obj(sides))
                options = ["--unit", "cm", "--faces", "500", "--subdivide", "0.1", "--no-progress"]
                subprocess.run([sys.argv[2], "improve", source, *options, "-o", file, "-o", ply], check=True, capture_output=True)
                mesh = vsplit.load(file)
                _, triangles, regions = read_ply_regions(ply.read_bytes())
                np.testing.assert_array_equal(mesh.at()[1], triangles)
                np.testing.assert_array_equal(mesh.regions_at(), regions)
                self.assertEqual(mesh.unit, "cm")
                self.assertEqual(list(mesh.sets), [f"side{side}" for side in range(sides)])
                self.assertEqual(len(mesh.regions_at(mesh.faces_max)), mesh.faces_max)
        golden = vsplit.load(DATA / "golden" / "file_1_closed.vsplit")
        self.assertIsNone(golden.regions_at())
        self.assertEqual((golden.unit, golden.sets), ("", {}))

    def test_figures_are_those_of_a_resolution(self):
        mesh = self.client.improve(self.session, faces=3000)
        held = mesh._decoder.records_held
        coarse = mesh.figures_at(2500)
        self.assertEqual(coarse.faces, len(mesh.at(2500)[1]))
        self.assertEqual(coarse.quality.stretch_min, self.client.quality(self.session, mesh, 2500).stretch_min)
        self.assertEqual(mesh._decoder.records_held, held)
        self.assertEqual(mesh.figures_at(mesh.faces_max).faces, mesh.faces_max)
        self.assertEqual(mesh.representation.faces, len(mesh.at()[1]))

    def test_a_method_starts_from_any_resolution_of_another(self):
        session = self.client.upload(box_obj(), unit="ft")
        mesh = self.client.improve(session, faces=800, subdivision_size=0.1)
        self.assertEqual(mesh.unit, "ft")
        for source, faces, expected in ((mesh, 0, mesh.representation.faces), (mesh, 500, 500), (mesh.representation.id, 600, 600)):
            made = self.client.control(session, source=source, source_faces=faces, timeout=60).representation
            self.assertEqual((made.source.representation, made.source.faces), (mesh.representation.id, expected))
        self.assertEqual(self.client.open(session).representation.id, made.id)
        self.assertEqual(self.client.open(session).representation.faces_max, made.faces_max)
        with self.assertRaises(grpc.RpcError) as late:
            self.client.improve(session, faces=300, timeout=1e-6)
        self.assertEqual(late.exception.code(), grpc.StatusCode.DEADLINE_EXCEEDED)
        self.client.delete(session)

    def test_all_sessions_are_listed_over_pages(self):
        with vsplit.Client(self.address) as client:
            made = [client._stub.CreateSession(v1.CreateSessionRequest()).id for _ in range(120)]
            found = [session.id for session in client.sessions()]
            self.assertEqual([session for session in found if session in set(made)], made)
            for session in made:
                client.delete(session)
        with self.assertRaises(ValueError):
            client.sessions()  # closed

    def test_problems_have_a_cause_and_a_field(self):
        with self.assertRaises(grpc.RpcError) as raised:
            self.client.improve(self.session, tolerance=-1)
        problem = vsplit.problem_of(raised.exception)
        self.assertEqual((problem.cause, problem.field, problem.retry_after), ("INVALID_OPTION", "tolerance", None))
        self.assertEqual(problem.message, raised.exception.details())
        with self.assertRaises(grpc.RpcError) as raised:
            vsplit.Client("127.0.0.1:1").sessions()
        self.assertEqual(vsplit.problem_of(raised.exception).cause, "UNAVAILABLE")

    def test_other_libraries_take_what_it_gives(self):
        mesh = self.client.improve(self.session, faces=3000)
        points, cells, _, cell_data, _, _, cell_sets = mesh.meshio_at(1000)
        self.assertEqual((cell_data, cell_sets), ({}, {}))
        self.assertEqual(cells[0][0], "triangle")
        self.assertLess(cells[0][1].max(), len(points))
        _, flat = mesh.pyvista_at(1000)
        self.assertEqual(len(flat), 4 * len(cells[0][1]))
        self.assertTrue((flat[::4] == 3).all())

    def test_meshio_takes_regions_and_sets(self):
        meshio = self.installed("meshio")
        session = self.client.upload(box_obj())
        made = self.client.improve(session, faces=500, subdivision_size=0.1)
        mesh = meshio.Mesh(*made.meshio_at(300))
        np.testing.assert_array_equal(mesh.cell_data["region"][0], made.regions_at(300))
        with tempfile.TemporaryDirectory() as folder:
            mesh.write(folder + "/box.inp")
            again = self.client.session(self.client.upload(folder + "/box.inp", session=session)).source
            self.assertEqual(again.faces, len(made.at(300)[1]))
            self.assertEqual(list(self.client.improve(session).sets), list(made.sets))
        self.client.delete(session)

    def test_files_of_every_version_and_encoding_are_read(self):
        golden = DATA / "golden"
        for shape in ("closed", "open"):
            points, faces = vsplit.load(golden / f"file_1_{shape}.vsplit").at(10**6)
            encodings = (("float64", 0), ("float32", 1e-6), ("quantised14", 1e-3))
            for version, (name, error) in itertools.product((2, 3), encodings):
                mesh = vsplit.load(golden / f"file_{version}_{name}_{shape}.vsplit")
                same_points, same_faces = mesh.at(10**6)
                np.testing.assert_array_equal(same_faces, faces)
                np.testing.assert_allclose(same_points, points, rtol=0, atol=error)
                self.assertEqual(len(mesh.at(10**6)[1]), mesh.faces_max)
                self.assertLess(len(mesh.at()[1]), mesh.faces_max)
        for path in (DATA / "broken").glob("*.vsplit"):
            with self.assertRaises(vsplit.CorruptError, msg=path):
                vsplit.load(path)

    def test_damage_is_refused(self):
        decoder = vsplit.mesh.Decoder()
        with self.assertRaisesRegex(vsplit.CorruptError, "no base mesh"):
            decoder.append(v1.RecordBlock(first=0, count=1, encoding=v1.FLOAT64, payload=b"x"))
        none = np.zeros(4, np.uint32)
        with self.assertRaisesRegex(vsplit.CorruptError, "without a base mesh"):
            decoder.set_regions(none, [])
        decoder.begin(np.eye(4, 3), np.array([[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]], np.uint32), 0)
        with self.assertRaisesRegex(vsplit.CorruptError, "regions of 3 faces came, expected are those of 4 or more"):
            decoder.set_regions(none[:3], [])
        with self.assertRaisesRegex(vsplit.CorruptError, "expected are 9"):
            vsplit.MeshFile.of_chunks([v1.MeshChunk(data=b"12345678", size=9)])
        with self.assertRaises(vsplit.CorruptError):
            decoder.begin_packed(b"xx", v1.BaseMesh(vertices=4, faces=4, encoding=v1.FLOAT32))

    def test_the_server_says_what_is_wrong(self):
        with self.assertRaises(grpc.RpcError) as raised:
            self.client.improve("none")
        self.assertEqual(raised.exception.code(), grpc.StatusCode.NOT_FOUND)
        with self.assertRaises(grpc.RpcError) as raised:
            self.client.improve(self.session, encoding="quantised", bits=3)
        self.assertIn("10 to 24", raised.exception.details())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
