#pragma once

#include "vsplit/mesh/triangle_mesh.h"
#include "vsplit/mesh/weld.h"

namespace vsplit {

/// Drops faces with two equal corners, then vertices without a face; what stays keeps its order. `merged_vertices` is 0.
/// O(vertices + faces) time, 4 bytes a vertex.
[[nodiscard]] WeldCounts drop_unused(TriangleMesh& mesh);

}  // namespace vsplit
