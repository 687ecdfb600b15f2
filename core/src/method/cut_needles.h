#pragma once

#include "method/prepare.h"
#include "vsplit/base/execution_context.h"

namespace vsplit {

/// `creased` with the needles of flat places cut to faces about as high as long. A strip along a cable is two needles; midpoints
/// would cut them to ever more needles, millions of them. Here edges that bound a flat place are halved while they are longer
/// than `size` and than twice the height of a face beside them, and between rounds of that the edges inside are flipped until
/// they are Delaunay. Creases and edges that bend are halved only, boundaries left alone. New vertices lie on edges there were,
/// after the others; flat is what lies within a slab of thickness `gap`, so the surface moves by that at most, which `moved` then
/// holds too. At most some 400,000 faces come out. \pre `creased.mesh` is manifold. O(faces of the result log size), the square
/// of the faces of a flat place at worst.
[[nodiscard]] CreasedMesh cut_needles(const CreasedMesh& creased, double size, double gap, const ExecutionContext& context);

}  // namespace vsplit
