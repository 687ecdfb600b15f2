#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// The triangulation of least area of a closed polygon in space, without new vertices: triangles of corner numbers, oriented as
/// the polygon runs. Empty when `allowed` forbids all. Barequet, Sharir: Filling Gaps in the Boundary of a Polyhedron (1995).
/// \param allowed whether a diagonal between two corners may be an edge.
/// \pre at least 3 corners. O(corners^3) time, O(corners^2) memory.
[[nodiscard]] std::vector<Triangle> triangulate_loop(std::span<const Vec3> corners,
                                                     const std::function<bool(std::uint32_t, std::uint32_t)>& allowed);

}  // namespace vsplit
