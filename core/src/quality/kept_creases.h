#pragma once

#include <optional>
#include <vector>

#include "vsplit/base/execution_context.h"
#include "vsplit/base/expected.h"
#include "vsplit/features/sharp_edges.h"
#include "vsplit/mesh/triangle_mesh.h"
#include "vsplit/quality/deviation.h"

namespace vsplit {

/// The largest distance from the points of `creases`, edges of `source`, to the creases of `result`, by branch and bound as in
/// measure_deviation; empty where there are no creases. What a crease of the result is:
/// - to a crease that bends by more than `angle` degrees or bounds the source, each edge that bends by more or is a boundary;
/// - to another (marked by the user, a border of regions, voted for), which no angle tells, each edge.
/// Infinite where the result has none. Reports no progress. \return INVALID_OPTION as measure_deviation, CANCELLED.
/// \pre both are manifold. O(faces + creases log edges).
[[nodiscard]] Expected<std::optional<DirectedDeviation>> measure_kept_creases(const TriangleMesh& result,
                                                                              const TriangleMesh& source,
                                                                              const std::vector<SharpEdge>& creases, double angle,
                                                                              const DeviationOptions& accuracy,
                                                                              const ExecutionContext& context);

/// The creases of `result` that come from `creases` of `source`, with weight 1: of the edges that bend by more than `angle` those
/// within `distance` of a crease that bends by more, at both ends and in the middle; edges that run along another crease, within
/// 3 % of their length; and boundary edges. \pre `result` is manifold. O(edges log creases).
[[nodiscard]] std::vector<SharpEdge> creases_kept(const TriangleMesh& result, const TriangleMesh& source,
                                                  const std::vector<SharpEdge>& creases, double angle, double distance);

}  // namespace vsplit
