#pragma once

#include <cstdint>
#include <functional>
#include <utility>
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

/// How many faces a subdivision may make.
struct FaceLimit {
    using Admit = std::function<Status(std::uint32_t faces)>;

    // NOLINTNEXTLINE(google-explicit-constructor): a number of faces is such a limit
    FaceLimit(std::uint32_t faces, Admit asked = {}) : most(faces), admit(std::move(asked)) {}

    std::uint32_t most;
    /// Asked when the number of faces is known, before memory is taken for them; its error ends the verb. Empty: they may.
    Admit admit;

    [[nodiscard]] Status check(std::uint64_t faces) const { return admit ? admit(static_cast<std::uint32_t>(faces)) : Done{}; }
};

/// Faces that subdivide_to_size would make, or `limit` + 1 when they are more than `limit`, or when `context` is cancelled. Takes
/// no memory to speak of. \pre max_edge > 0. O(min(result, limit)).
[[nodiscard]] std::uint64_t predict_subdivision(const TriangleMesh& mesh, double max_edge, std::uint64_t limit,
                                                const ExecutionContext* context = nullptr);

/// Selective midpoint subdivision ([Date05] 4.1, Fig. 6): midpoints on every edge longer than `max_edge` (sigma_SZ, length),
/// each face cut by its 1, 2 or 3 marked edges, until none is longer. The surface does not change.
///
/// Stage "subdivide". \return INVALID_OPTION (max_edge not positive and finite); LIMIT_EXCEEDED when more than `limit.most`
/// faces would come out, naming a max_edge that fits; what limit.admit says; CANCELLED. O(result) time and memory.
[[nodiscard]] Expected<SubdividedMesh> subdivide_to_size(const TriangleMesh& mesh, double max_edge, const FaceLimit& limit,
                                                         const ExecutionContext& context);

/// One-to-four subdivision, `times` over ([Date05] 5.1): similar triangles, so the distribution of stretch stays.
///
/// Stage "subdivide". \return INVALID_OPTION (times > 12); LIMIT_EXCEEDED naming the largest `times` that fits; what
/// limit.admit says; CANCELLED.
[[nodiscard]] Expected<SubdividedMesh> subdivide_one_to_four(const TriangleMesh& mesh, std::uint32_t times,
                                                             const FaceLimit& limit, const ExecutionContext& context);

}  // namespace vsplit
