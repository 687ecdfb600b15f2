#pragma once

#include <vector>

#include "mesh/half_edges.h"
#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// The loops of a mesh's open boundary, each as its half-edges in the order in which they follow one another; loops in order of
/// their first half-edge. \pre `mesh` is manifold. O(faces).
[[nodiscard]] std::vector<std::vector<HalfEdge>> boundary_loops(const TriangleMesh& mesh);

}  // namespace vsplit
