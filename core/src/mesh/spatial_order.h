#pragma once

#include "vsplit/subdivide/subdivide.h"

namespace vsplit {

/// Renumbers vertices and faces along a Morton curve, so that neighbours on the surface are neighbours in memory. Geometry and
/// corner order stay. Deterministic: ties keep their order. O(n log n).
void order_spatially(SubdividedMesh& subdivided);

}  // namespace vsplit
