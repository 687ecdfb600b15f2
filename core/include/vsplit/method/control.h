#pragma once

#include "vsplit/base/execution_context.h"
#include "vsplit/base/expected.h"
#include "vsplit/mesh/triangle_mesh.h"
#include "vsplit/method/method_options.h"
#include "vsplit/method/method_result.h"

namespace vsplit {

/// `options` with every field filled in for this mesh (bounds but min_stretch, and in STRICT mode max_deviation, stay empty:
/// none). O(faces).
[[nodiscard]] ControlOptions default_options(const TriangleMesh& mesh, const ControlOptions& options);

/// Mesh property control, [Date05] 5: one-to-four subdivision, then collapses under bounds on each face's shape and size and each
/// vertex's valence, those that mend a violator first.
///
/// What no collapse mends is mended first: faces over max_size are cut, vertices over max_valence by splits and flips; see
/// docs/method.md, "Bounds of control". Where bounds are broken at the faces asked for, a resolution within 10 % at which all
/// hold is shown instead, and without `faces` one further away. Bounds that cannot be met are reported in `violations`; they are
/// no error. Stages and errors as in `improve`.
[[nodiscard]] Expected<MethodResult> control(const TriangleMesh& mesh, const ControlOptions& options, const MethodLimits& limits,
                                             const ExecutionContext& context);

/// Counts and lists what breaks a bound of `options` on a mesh, face by face; but max_deviation. `reason` is left empty.
/// O(faces).
[[nodiscard]] std::vector<Violation> find_violations(const TriangleMesh& mesh, const ControlOptions& options);

}  // namespace vsplit
