#pragma once

#include <span>
#include <vector>

#include "io/read_error.h"
#include "vsplit/base/expected.h"
#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// Cuts a polygon in space into triangles of corner numbers: two fewer than corners, all running as the polygon does. Where the
/// fan around the first corner does not fold and has no triangle without area, as with a convex polygon that has no corner in the
/// middle of a side, it is that fan; else ears are cut off one by one, seen along the polygon's normal, without folding and,
/// where there is such a cut, without triangles of no area. Polygons that cross themselves have no such cut: what is left of them
/// is a fan. \return empty for a polygon that would take too long: many thousands of corners, most of them in each other's way.
/// \pre at least 3 corners. O(corners) for convex ones, at most 2,000 tests a corner for others.
[[nodiscard]] std::vector<Triangle> cut_polygon(std::span<const Vec3> corners);

/// Cuts the polygon that `fan` is the fan of, in place. \return LIMIT_EXCEEDED at `place` where that would take too long.
[[nodiscard]] Status unfold_fan(const std::vector<Vec3>& positions, std::span<Triangle> fan, Place place);

}  // namespace vsplit
