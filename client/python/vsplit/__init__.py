"""Client of a vsplit server: meshes go in, meshes fit for analysis come out, at any resolution.

    import vsplit
    client = vsplit.Client("127.0.0.1:50051")
    session = client.upload("part.stl")
    mesh = client.improve(session, tolerance=0.2, encoding="quantised", bits=14)
    points, faces = mesh.at(20000)            # float64 (n, 3), uint32 (m, 3)
    vsplit.load("part.vsplit").at(20000)      # a file that `vsplit improve` wrote
    meshio.Mesh(*mesh.meshio_at(20000)); pyvista.PolyData(*mesh.pyvista_at(20000))
"""

from .client import Client
from .decoder import CorruptError
from .mesh import Mesh, StoredMesh, load

__all__ = ["Client", "CorruptError", "Mesh", "StoredMesh", "load"]
