#pragma once

#include <cstddef>

#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit::bench {

/// Pairs of faces without a common vertex of which an edge of one passes through the inside of the other. Signs that rounding of
/// doubles leaves open count as touching, and touching is no intersection, nor is an overlap within one plane.
/// O(faces * faces that overlap along the longest axis).
[[nodiscard]] std::size_t count_self_intersections(const TriangleMesh& mesh);

}  // namespace vsplit::bench
