#pragma once

#include <vector>

#include "quality/face_bounds.h"
#include "vsplit/method/method_options.h"
#include "vsplit/method/method_result.h"

namespace vsplit {

/// What `options` bound of a face's shape, with 1e-12 of it for rounding but at min_stretch, which is kept as the paper has it.
[[nodiscard]] FaceBounds face_bounds(const ControlOptions& options);

/// Says of each violation why it was left: what lies between creases, what was tried, what would help. `mesh` is the resolution
/// that `result` shows, and breaks the bounds so; `options` are as used. O(faces).
void explain(MethodResult& result, const TriangleMesh& mesh, const ControlOptions& options);

}  // namespace vsplit
