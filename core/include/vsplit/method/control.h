#pragma once

#include "vsplit/base/execution_context.h"
#include "vsplit/base/expected.h"
#include "vsplit/mesh/triangle_mesh.h"
#include "vsplit/method/method_options.h"
#include "vsplit/method/method_result.h"

namespace vsplit {

/// `options` with every field filled in for this mesh (max_size, max_valence and in STRICT mode max_deviation stay
/// empty: no bound). O(faces).
[[nodiscard]] ControlOptions default_options(const TriangleMesh& mesh, const ControlOptions& options);

/// Mesh property control, [Date05] 5: one-to-four subdivision, then collapses under bounds on stretch, size and valence, those
/// that mend a violator first.
///
/// Faces over max_size are subdivided first, since no collapse can mend them. Bounds that cannot be met are reported in
/// `violations`; they are no error. Stages and errors as in `improve`.
[[nodiscard]] Expected<MethodResult> control(const TriangleMesh& mesh, const ControlOptions& options, const MethodLimits& limits,
                                             const ExecutionContext& context);

/// Counts what breaks a bound of `options` on a mesh, face by face. `reason` is left empty. O(faces).
[[nodiscard]] std::vector<Violation> find_violations(const TriangleMesh& mesh, const ControlOptions& options);

}  // namespace vsplit
