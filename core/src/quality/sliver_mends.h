#pragma once

#include <optional>

#include "features/crease_marks.h"
#include "quality/held_creases.h"
#include "quality/sliver_features.h"
#include "spatial/surface_index.h"
#include "vsplit/features/face_normals.h"

namespace vsplit {

/// Of feature_angle: what a source's crease may have been flattened to and still be one in the result.
inline constexpr double kCreaseBendShare = 0.5;

/// The mesh that slivers are to be mended in, and what that must keep. All must outlive this.
struct MendedMesh {
    const TriangleMesh& mesh;
    const CreaseMarks& marks;
    const FaceNormals& normals;  ///< of `mesh`
    double crease_angle = 0;     ///< degrees: a crease that bends by more goes on doing so
    const SurfaceIndex* source = nullptr;
    const HeldCreases* creases = nullptr;
};

/// The least length by which one step that mends a sliver and makes no other moves the surface: a flip of one of its edges, or a
/// collapse of one into either end, neither across a crease nor with a fold, nor so that a crease no longer bends or one of the
/// source is left alone. Empty where there is no such step, or the vertex that goes has more than 64 faces. Measured locally:
/// between the diagonals, or from the vertex that goes and the centroids of the faces around to one another; and from corners,
/// centroids and middles of edges of the new faces to the source. O(square of the valence).
[[nodiscard]] std::optional<double> least_mend(const MendedMesh& mended, const SliverFace& face);

}  // namespace vsplit
