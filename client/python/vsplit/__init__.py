"""Client of a vsplit server: meshes go in, meshes fit for analysis come out, at any resolution.

    import vsplit
    client = vsplit.Client("127.0.0.1:50051")
    session = client.upload("part.stl", unit="mm", repair="safe")
    mesh = client.improve(session, tolerance=0.2, encoding="quantised", bits=14)
    points, faces = mesh.at(20000)            # float64 (n, 3), uint32 (m, 3)
    mesh.regions_at(20000), mesh.sets         # uint32 (m,), or None; the regions that each name stands for
    client.quality(session, mesh, 20000, profile="optistruct").profile.failed
    open("part.inp", "wb").write(client.download(session, mesh, 20000, "inp", order=2))
    vsplit.load("part.vsplit").at(20000)      # a file that `vsplit improve` wrote
    meshio.Mesh(*mesh.meshio_at(20000)); pyvista.PolyData(*mesh.pyvista_at(20000))
"""

from .client import Client
from .decoder import CorruptError
from .mesh import Mesh, StoredMesh, load
from .mesh_file import MeshFile
from .problem import Problem, problem_of

__all__ = ["Client", "CorruptError", "Mesh", "MeshFile", "Problem", "StoredMesh", "load", "problem_of"]
