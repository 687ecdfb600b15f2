#pragma once

#include <cstdint>
#include <vector>

#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// What `weld` does to vertices: those that stay are moved to the front of `positions`, in order. Returns each vertex's new
/// number. \pre 0 <= tolerance < infinity.
[[nodiscard]] std::vector<std::uint32_t> merge_vertices(std::vector<Vec3>& positions, double tolerance);

}  // namespace vsplit
