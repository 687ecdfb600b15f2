#pragma once

#include "vsplit/base/execution_context.h"
#include "vsplit/base/expected.h"
#include "vsplit/mesh/triangle_mesh.h"
#include "vsplit/method/method_options.h"
#include "vsplit/method/method_result.h"

namespace vsplit {

/// `options` with every field filled in for this mesh, as far as can be told before the work: in STRICT mode
/// max_deviation stays empty (no bound), and `faces` is an estimate that improve() replaces by what sizes ask for (EXTENDED), or
/// raises to twice the coarsest resolution where that is more. O(faces).
[[nodiscard]] ImproveOptions default_options(const TriangleMesh& mesh, const ImproveOptions& options, const MethodLimits& limits);

/// Mesh quality improvement, [Date05] 4: subdivides until no edge is longer than sigma_SZ, then collapses edges in the order
/// of quality gained, within the tolerance, and keeps every collapse as a vertex split. EXTENDED adds edge flips and vertex moves
/// and bounds the deviation, see docs/method.md; max_deviation that cannot be met is reported in `violations`.
///
/// Stages: "inspect", "subdivide", "evaluate", "simplify", and "measure" in EXTENDED. The same input and options give the same
/// bits for any thread count. Open boundaries and components are kept, see docs/method.md.
/// \return EMPTY_INPUT or NON_MANIFOLD for a mesh that is no 2-manifold, such as one whose boundary touches itself;
/// INVALID_OPTION, UNSUPPORTED,
///         LIMIT_EXCEEDED, CANCELLED.
/// Complexity: O(n log n) in the faces after subdivision, for bounded valence. Memory: about 250 bytes a face.
[[nodiscard]] Expected<MethodResult> improve(const TriangleMesh& mesh, const ImproveOptions& options, const MethodLimits& limits,
                                             const ExecutionContext& context);

}  // namespace vsplit
