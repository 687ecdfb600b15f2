#pragma once

#include <vector>

#include "vsplit/features/sharp_edges.h"
#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// `creases` without those that noise makes: branches that end freely, at a vertex of no other crease, and are shorter than
/// `least` from there to where they meet others. The shortest go first, and what meets where one hung is one branch then: a long
/// crease that frays stays. Nothing goes where a strip `least` wide along all such branches is under a fiftieth of the surface:
/// so few cost no shape, and those of a part may be meant. Order is kept. `least` of 0 keeps all.
/// O(creases log creases) times the edges of the branches that are looked at.
[[nodiscard]] std::vector<SharpEdge> without_noise(std::vector<SharpEdge> creases, const TriangleMesh& mesh, double least);

}  // namespace vsplit
