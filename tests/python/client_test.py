"""The Python client against a server of its own: client_test.py VSPLITD."""

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


def read_ply(data):
    """As vsplit writes it: little-endian, doubles."""
    head, body = data.split(b"end_header\n", 1)
    counts = {line.split()[1]: int(line.split()[2]) for line in head.decode().splitlines() if line.startswith("element")}
    size = counts["vertex"] * 24
    points = np.frombuffer(body[:size], "<f8").reshape(-1, 3)
    faces = np.frombuffer(body[size:], np.dtype([("n", "u1"), ("v", "<u4", 3)]))["v"]
    return points, faces


class ClientTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.server = subprocess.Popen([sys.argv[1], "--listen", "127.0.0.1:0", "--http", "off"], stdout=subprocess.PIPE, text=True)
        line = cls.server.stdout.readline()
        cls.client = vsplit.Client("127.0.0.1:" + line.rsplit(":", 1)[1].split()[0].strip().rstrip("."))
        cls.session = cls.client.upload(DATA / "bracket.stl")

    @classmethod
    def tearDownClass(cls):
        cls.client.close()
        cls.server.terminate()
        cls.server.wait(20)

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

    def test_other_libraries_take_what_it_gives(self):
        mesh = self.client.improve(self.session, faces=3000)
        points, cells = mesh.meshio_at(1000)
        self.assertEqual(cells[0][0], "triangle")
        self.assertLess(cells[0][1].max(), len(points))
        _, flat = mesh.pyvista_at(1000)
        self.assertEqual(len(flat), 4 * len(cells[0][1]))
        self.assertTrue((flat[::4] == 3).all())

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
