#pragma once

#include <vector>

#include "mesh/half_edges.h"

namespace vsplit {

/// Turns the edge of half-edge h within the quad of its two faces, in the arrays that say what a mesh is; see EdgeFlip for the
/// corners. Each function undoes the other, byte for byte, and either half-edge of the edge gives the same.
/// \pre the edge's two faces have four vertices together. O(1).

/// h: a -> b in (a, b, c), its twin in (b, a, d). Afterwards h runs d -> c in (d, c, a) and the twin c -> d in (c, d, b).
void turn_counter_clockwise(TriangleMesh& mesh, std::vector<HalfEdge>& twin, HalfEdge h);

/// h: p -> q in (p, q, r), its twin in (q, p, s). Afterwards h runs r -> s in (r, s, q) and the twin s -> r in (s, r, p).
void turn_clockwise(TriangleMesh& mesh, std::vector<HalfEdge>& twin, HalfEdge h);

}  // namespace vsplit
