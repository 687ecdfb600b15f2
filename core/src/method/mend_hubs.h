#pragma once

#include <memory>

#include "method/prepare.h"
#include "vsplit/base/execution_context.h"

namespace vsplit {

/// `mesh` without vertices of more edges than options.max_valence, as far as splits and flips go; null where there are none or
/// nothing helps. Each crease and open boundary stays, and the surface but for flips within the tolerance. The vertices there
/// were keep their numbers.
///
/// Collapses seldom mend a hub of many slivers: its neighbours have as few edges as they may. Here every other spoke is cut near
/// its rim, as far in as the rim's edges are long, and those between are flipped onto the cuts: half as many spokes, and a ring
/// of faces of good shape; again until few enough are left. O(faces + n log n) for hubs of n edges in all; at most 2 faces more
/// for each of them. \pre `mesh` is manifold; `options` are as used.
[[nodiscard]] std::shared_ptr<const CreasedMesh> mend_hubs(const TriangleMesh& mesh, const ControlOptions& options,
                                                           const ExecutionContext& context);

}  // namespace vsplit
