#pragma once

#include <vector>

#include "vsplit/features/normal_voting.h"
#include "vsplit/features/sharp_edges.h"

namespace vsplit {

/// Edges whose ends lie on creases or corners and whose faces' voted normals differ by more than `options.angle`, without chains
/// shorter than a neighbourhood; closed ones stay, since holes are small and noise makes no loops. Boundaries left out.
[[nodiscard]] std::vector<SharpEdge> voted_edges(const TriangleMesh& mesh, const FaceNormals& normals, double angle,
                                                 double weight);

}  // namespace vsplit
