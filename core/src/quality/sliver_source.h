#pragma once

#include <vector>

#include "quality/held_creases.h"
#include "spatial/surface_index.h"
#include "vsplit/quality/slivers.h"

namespace vsplit {

/// What a mesh with slivers was made from. All must outlive this.
struct SliverSource {
    const SurfaceIndex& surface;
    const TriangleMesh& mesh;
    const std::vector<SharpEdge>& creases;  ///< edges of it
};

/// explain_slivers for who has the source at hand: a mend then counts only where its faces are within max_deviation of that,
/// too, and the source's creases within max_deviation of the creases beside those that go. O(creases log creases) more.
[[nodiscard]] std::vector<Slivers> explain_slivers(const TriangleMesh& mesh, const std::vector<SharpEdge>& creases,
                                                   const SliverOptions& options, const SliverSource& source);

}  // namespace vsplit
