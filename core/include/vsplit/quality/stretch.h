#pragma once

#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// Floor for finite-element solvers ([Date05] 3.3).
inline constexpr double kStretchFloor = 0.2;

/// Area of the equilateral triangle of edge 1.
inline constexpr double kEquilateralArea = 0.4330127018922193;

/// Stretch of the triangle (a, b, c), [Date05] Eq. 6: sqrt(12) * inradius / longest edge. 1 equilateral, 0 degenerate.
[[nodiscard]] double stretch(const Vec3& a, const Vec3& b, const Vec3& c);

/// Size of the triangle (a, b, c), [Date05] Eq. 5: its longest edge.
[[nodiscard]] double face_size(const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace vsplit
