#pragma once

#include <string>
#include <vector>

#include "vsplit/mesh/triangle_mesh.h"
#include "vsplit/mesh/weld.h"

namespace vsplit {

/// Drops faces with two equal corners, then vertices without a face; what stays keeps its order. `merged_vertices` is 0.
/// O(vertices + faces) time, 4 bytes a vertex.
[[nodiscard]] WeldCounts drop_unused(TriangleMesh& mesh);

/// Drops sets without a face. \return their names. O(faces log regions + members of sets).
[[nodiscard]] std::vector<std::string> drop_unused_sets(TriangleMesh& mesh);

}  // namespace vsplit
