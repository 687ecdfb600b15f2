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

class PreparedTriangle;

/// A segment; both ends may be equal.
struct SegmentShape {
    using Prepared = SegmentShape;
    static constexpr std::size_t kCorners = 2;
    std::array<Vec3, kCorners> corners;

    [[nodiscard]] Footpoint closest(const Vec3& p) const;
    [[nodiscard]] Footpoint closest(const Vec3& p, double /*most*/) const { return closest(p); }

    /// The half-spaces of unit normal across its ends: within both, the nearest point is no end.
    [[nodiscard]] std::array<HalfSpace, kCorners> sides() const;
};

/// A triangle; it may have no area, or be a point.
struct TriangleShape {
    using Prepared = PreparedTriangle;
    static constexpr std::size_t kCorners = 3;
    std::array<Vec3, kCorners> corners;

    /// Exact up to rounding, which for slivers too can be no more than about 1e-8 of the longest edge, and then to the far side:
    /// the point given is always one of the triangle.
    [[nodiscard]] Footpoint closest(const Vec3& p) const;

    /// The half-spaces of unit normal across its edges, perpendicular to its plane.
    [[nodiscard]] std::array<HalfSpace, kCorners> sides() const;
};

/// A triangle that many points are measured to: what depends on it alone is found once. Says what TriangleShape says, bit for
/// bit.
class PreparedTriangle {
public:
    PreparedTriangle() = default;
    explicit PreparedTriangle(const TriangleShape& shape);

    [[nodiscard]] Footpoint closest(const Vec3& p) const;
    /// The same where it is no further than the root of `most`; else that, or infinity as the distance.
    [[nodiscard]] Footpoint closest(const Vec3& p, double most) const;

    /// The squared distance to p where it is less than `most`; else that, or anything from `most` on.
    [[nodiscard]] double squared_distance(const Vec3& p, double most) const;

    [[nodiscard]] std::array<HalfSpace, TriangleShape::kCorners> sides() const { return shape_.sides(); }

private:
    /// Barycentric weights of the projection of p, times |normal|^2. Each grows along the product of the normal and the edge
    /// opposite, so they keep a relative error of rounding over (height / length); the Gram determinants of the usual form would
    /// square that.
    struct Weights {
        double a, b, c;
    };
    [[nodiscard]] Weights weights(const Vec3& p) const;
    [[nodiscard]] Footpoint closest(const Vec3& p, const Weights& weights) const;
    /// Whether p lies further than the root of `most` beyond the line of an edge, by what is far over any rounding.
    [[nodiscard]] bool is_beyond(const Vec3& p, const Weights& weights, double most) const;

    TriangleShape shape_;
    Vec3 rise_b_ = Vec3::Zero(), rise_c_ = Vec3::Zero();  // gradients of the weights of b and c
    double whole_ = 0;                                    // |normal|^2
    std::array<double, 3> far_{};  // of a, b, c: what a weight's square is at a distance of 1 beyond the edge opposite
    bool thin_ = false;
};

}  // namespace vsplit
