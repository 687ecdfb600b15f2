#include "mesh/cap_boundaries.h"

#include <utility>
#include <vector>

#include "mesh/boundary_loops.h"
#include "vsplit/mesh/inspect.h"

namespace vsplit {
namespace {

Vec3 centroid(const TriangleMesh& mesh, const std::vector<HalfEdge>& loop) {
    Vec3 sum = Vec3::Zero();
    for (const HalfEdge h : loop) sum += mesh.positions[origin(mesh, h)];
    return sum / static_cast<double>(loop.size());
}

}  // namespace

Expected<CappedMesh> cap_boundaries(TriangleMesh mesh) {
    if (Status manifold = require_manifold(inspect(mesh)); !manifold) return manifold.error();
    return cap_manifold(std::move(mesh));
}

CappedMesh cap_manifold(TriangleMesh mesh) {
    const std::vector<std::vector<HalfEdge>> loops = boundary_loops(mesh);
    CappedMesh capped;
    capped.ghosts = static_cast<std::uint32_t>(loops.size());
    if (loops.empty()) {
        capped.mesh = std::move(mesh);
        return capped;
    }
    std::vector<Triangle> ghost_faces;
    capped.mesh.positions.reserve(loops.size() + mesh.positions.size());
    for (std::uint32_t ghost = 0; ghost < capped.ghosts; ++ghost) {
        capped.mesh.positions.push_back(centroid(mesh, loops[ghost]));
        for (const HalfEdge h : loops[ghost]) {
            ghost_faces.push_back({origin(mesh, next(h)) + capped.ghosts, origin(mesh, h) + capped.ghosts, ghost});
        }
    }
    capped.mesh.positions.insert(capped.mesh.positions.end(), mesh.positions.begin(), mesh.positions.end());
    capped.mesh.faces = std::move(mesh.faces);
    for (Triangle& face : capped.mesh.faces) {
        for (std::uint32_t& vertex : face) vertex += capped.ghosts;
    }
    capped.mesh.faces.insert(capped.mesh.faces.end(), ghost_faces.begin(), ghost_faces.end());
    return capped;
}

TriangleMesh visible_mesh(TriangleMesh complex, std::uint32_t ghosts) {
    if (ghosts == 0) return complex;
    if (!complex.regions.empty()) {
        std::size_t kept = 0;
        for (std::size_t f = 0; f < complex.faces.size(); ++f) {
            if (!touches_ghost(complex.faces[f], ghosts)) complex.regions[kept++] = complex.regions[f];
        }
        complex.regions.resize(kept);
    }
    std::erase_if(complex.faces, [ghosts](const Triangle& face) { return touches_ghost(face, ghosts); });
    for (Triangle& face : complex.faces) {
        for (std::uint32_t& vertex : face) vertex -= ghosts;
    }
    complex.positions.erase(complex.positions.begin(), complex.positions.begin() + ghosts);
    return complex;
}

}  // namespace vsplit
