#pragma once

#include "simplify/crease_guard.h"
#include "simplify/half_edge_mesh.h"
#include "simplify/local_state.h"

namespace vsplit {

/// Has the points of `guard` go over to the nearest creases of the mesh as it stands, edges that bend by more than the angle of
/// `crease_cosine` and were none before among them. Creases that hold no points and bend by less than half of that are none from
/// now on: they hold nothing but the faces beside them. O(edges + points log edges).
void settle_creases(HalfEdgeMesh& mesh, const LocalState& state, CreaseGuard& guard, double crease_cosine);

}  // namespace vsplit
