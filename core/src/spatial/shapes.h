#pragma once

#include <array>
#include <cstddef>

#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// The point of a shape nearest to a query.
struct Footpoint {
    double squared_distance = 0;
    Vec3 point = Vec3::Zero();
};

/// The points x with normal.dot(x) <= offset. A zero normal stands for a side that a degenerate shape does not have.
struct HalfSpace {
    Vec3 normal = Vec3::Zero();
    double offset = 0;

    /// How far x lies outside; negative inside.
    [[nodiscard]] double excess(const Vec3& x) const { return normal.dot(x) - offset; }
};

/// A segment; both ends may be equal.
struct SegmentShape {
    static constexpr std::size_t kCorners = 2;
    std::array<Vec3, kCorners> corners;

    [[nodiscard]] Footpoint closest(const Vec3& p) const;

    /// The half-spaces of unit normal across its ends: within both, the nearest point is no end.
    [[nodiscard]] std::array<HalfSpace, kCorners> sides() const;
};

/// A triangle; it may have no area, or be a point.
struct TriangleShape {
    static constexpr std::size_t kCorners = 3;
    std::array<Vec3, kCorners> corners;

    /// Exact up to rounding, which for slivers too can be no more than about 1e-8 of the longest edge, and then to the far side:
    /// the point given is always one of the triangle.
    [[nodiscard]] Footpoint closest(const Vec3& p) const;

    /// The half-spaces of unit normal across its edges, perpendicular to its plane.
    [[nodiscard]] std::array<HalfSpace, kCorners> sides() const;
};

}  // namespace vsplit
