#pragma once

#include <cstdint>
#include <vector>

#include "vsplit/features/face_normals.h"
#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// An edge to keep in place, and how strongly.
struct SharpEdge {
    std::uint32_t a = 0;
    std::uint32_t b = 0;
    double weight = 0;  ///< w_e of [Date05] Eq. 2
};

struct SharpEdgeOptions {
    double angle = 40;   ///< degrees, 0..180: an edge is sharp when its two faces' normals differ by more than this
    double weight = 10;  ///< weight of an edge whose faces meet at a right angle; others weigh weight * (1 - cos of the angle)
};

/// Sharp edges by dihedral angle ([Date05] 3.1) and edges with one face, in order of their first half-edge. O(faces).
/// \pre `mesh` is manifold; `normals` belong to it.
[[nodiscard]] std::vector<SharpEdge> find_sharp_edges(const TriangleMesh& mesh, const FaceNormals& normals,
                                                      const SharpEdgeOptions& options);

}  // namespace vsplit
