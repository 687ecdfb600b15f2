#pragma once

#include <optional>

#include "features/crease_marks.h"

namespace vsplit {

/// The width of the strip between two creases that a face lies in, measured straight over the surface, across the face's longest
/// edge and through its centroid; empty where that is over `reach`, or where there is no crease on either side. `longest` is the
/// half-edge of the longest edge. Faces are laid out in a plane by their edges' lengths, so that slivers and curved strips do no
/// harm. At most 64 faces a side are crossed.
[[nodiscard]] std::optional<double> crease_gap(const TriangleMesh& mesh, const CreaseMarks& marks, HalfEdge longest,
                                               double reach);

}  // namespace vsplit
