#pragma once

#include <cstdint>
#include <vector>

#include "vsplit/base/execution_context.h"
#include "vsplit/base/expected.h"
#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// A finer mesh of the same surface. `parent[f]` is the face of the source that face f lies in.
struct SubdividedMesh {
    TriangleMesh mesh;
    std::vector<std::uint32_t> parent;
};

/// Faces that subdivide_to_size would make, or `limit` + 1 when they are more than `limit`. Takes no memory to speak of.
/// \pre max_edge > 0. O(min(result, limit)).
[[nodiscard]] std::uint64_t predict_subdivision(const TriangleMesh& mesh, double max_edge, std::uint64_t limit);

/// Selective midpoint subdivision ([Date05] 4.1, Fig. 6): midpoints on every edge longer than `max_edge` (sigma_SZ, length),
/// each face cut by its 1, 2 or 3 marked edges, until none is longer. The surface does not change.
///
/// Stage "subdivide". \return INVALID_OPTION (max_edge not positive and finite); LIMIT_EXCEEDED when more than `face_limit` faces
/// would come out, naming a max_edge that fits; CANCELLED. O(result) time and memory.
[[nodiscard]] Expected<SubdividedMesh> subdivide_to_size(const TriangleMesh& mesh, double max_edge, std::uint32_t face_limit,
                                                         const ExecutionContext& context);

/// One-to-four subdivision, `times` over ([Date05] 5.1): similar triangles, so the distribution of stretch stays.
///
/// Stage "subdivide". \return INVALID_OPTION (times > 12); LIMIT_EXCEEDED naming the largest `times` that fits; CANCELLED.
[[nodiscard]] Expected<SubdividedMesh> subdivide_one_to_four(const TriangleMesh& mesh, std::uint32_t times,
                                                             std::uint32_t face_limit, const ExecutionContext& context);

}  // namespace vsplit
