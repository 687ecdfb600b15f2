#pragma once

#include <vector>

#include "mesh/half_edges.h"
#include "vsplit/features/face_normals.h"
#include "vsplit/shapes/shape_features.h"

namespace vsplit {

/// Rounded edges of a mesh, in no order and without ids: tubes with two long sides that run smoothly into what they join.
/// \pre a closed manifold. O(faces log faces).
[[nodiscard]] std::vector<ShapeFeature> find_fillets(const TriangleMesh& mesh, const FaceNormals& normals,
                                                     const std::vector<HalfEdge>& twin, double angle);

}  // namespace vsplit
