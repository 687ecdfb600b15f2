#pragma once

#include <cstdint>
#include <vector>

#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

struct BoundaryCornerOptions {
    double angle = 40;  ///< degrees, 0..180: a corner is where the boundary turns by more than this
    double reach = 0;   ///< length >= 0: and does so too between the points of it this far before and after, so that a boundary
                        ///< that is merely rough has none
};

/// Vertices at which an open boundary of `mesh` has a corner, in order of the loops. \pre `mesh` is manifold.
/// O(faces + boundary edges * those within reach).
[[nodiscard]] std::vector<std::uint32_t> boundary_corners(const TriangleMesh& mesh, const BoundaryCornerOptions& options);

}  // namespace vsplit
