#pragma once

#include "mesh/half_edges.h"

namespace vsplit {

/// Over half-edges, so that an edge counts once a face; 0 without faces. O(faces).
[[nodiscard]] inline double mean_edge(const TriangleMesh& mesh) {
    const auto count = static_cast<HalfEdge>(mesh.faces.size() * 3);
    double sum = 0;
    for (HalfEdge h = 0; h < count; ++h) sum += (mesh.positions[origin(mesh, next(h))] - mesh.positions[origin(mesh, h)]).norm();
    return count == 0 ? 0 : sum / count;
}

}  // namespace vsplit
