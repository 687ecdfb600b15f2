#pragma once

#include <optional>

#include "features/crease_marks.h"
#include "quality/sliver_features.h"
#include "vsplit/features/face_normals.h"

namespace vsplit {

/// The least length by which one step that raises a sliver's stretch moves the surface: a flip of its longest edge, or a collapse
/// of its shortest into either end, neither across a crease nor with a fold. Empty where there is no such step, or the
/// vertex that goes has more than 64 faces. Measured
/// locally: between the diagonals, or from the vertex that goes and the centroids of the faces around to one another.
/// \pre `normals` belong to `mesh`. O(square of the valence).
[[nodiscard]] std::optional<double> least_mend(const TriangleMesh& mesh, const CreaseMarks& marks, const FaceNormals& normals,
                                               const SliverFace& face);

}  // namespace vsplit
