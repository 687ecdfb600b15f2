#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "vsplit/base/execution_context.h"
#include "vsplit/base/expected.h"
#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// Two faces, the smaller index first.
using FacePair = std::array<std::uint32_t, 2>;

/// Pairs that a search looks at: a few seconds.
inline constexpr std::uint64_t kMostFacePairs = 4'000'000'000;

/// Pairs of faces, ascending, without a common vertex whose insides cross, be it that the cut begins and ends on edges, as those
/// of boxes on a grid do. Signs that rounding of doubles leaves open count as touching, and touching is no intersection, nor is
/// an overlap within one plane. \return LIMIT_EXCEEDED for a mesh of which more than kMostFacePairs pairs overlap along its
/// longest axis; CANCELLED. O(faces * faces that overlap along the longest axis), in parallel.
[[nodiscard]] Expected<std::vector<FacePair>> find_self_intersections(const TriangleMesh& mesh,
                                                                      const ExecutionContext& context = ExecutionContext());

}  // namespace vsplit
