#pragma once

#include <optional>

#include "features/crease_marks.h"
#include "quality/sliver_features.h"
#include "vsplit/features/face_normals.h"

namespace vsplit {

/// The least length by which one step that mends a sliver and makes no other moves the surface: a flip of its longest edge, or a
/// collapse of its shortest into either end, neither across a crease nor with a fold, nor so that a crease that bends by more
/// than `crease_angle` degrees no longer does. Empty where there is no such step, or the vertex that goes has more than 64 faces.
/// Measured locally: between the diagonals, or from the vertex that goes and the centroids of the faces around to one another.
/// \pre `normals` belong to `mesh`. O(square of the valence).
[[nodiscard]] std::optional<double> least_mend(const TriangleMesh& mesh, const CreaseMarks& marks, const FaceNormals& normals,
                                               double crease_angle, const SliverFace& face);

}  // namespace vsplit
