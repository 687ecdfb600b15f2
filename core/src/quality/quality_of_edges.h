#pragma once

#include "mesh/half_edges.h"
#include "vsplit/quality/mesh_quality.h"

namespace vsplit {

/// measure_quality for who has the mesh's edges at hand.
[[nodiscard]] Quality measure_quality(const TriangleMesh& mesh, const EdgeIndex& edges);

}  // namespace vsplit
