#pragma once

#include <Eigen/Core>

#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// A sum of weighted squared distances to planes and lines, error(x) = x^T A x + 2 b.x + c ([Date05] Eq. 1-4, [GH97]).
/// Adding quadrics adds their sums. Units: length^2. Give points relative to a centre near the mesh: c grows with |x|^2.
struct Quadric {
    // A is symmetric: xx, xy, xz, yy, yz, zz.
    double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
    Vec3 b = Vec3::Zero();
    double c = 0;

    /// Squared distance to the plane through `point` with unit normal `normal`.
    [[nodiscard]] static Quadric plane(const Vec3& normal, const Vec3& point);

    /// `weight` times the squared distance to the line through `point` with unit direction `direction`. The paper prints Eq. 3
    /// with (d.p)^2 d and Eq. 4 with a plus sign; both are misprints (the error at `point` must be 0).
    [[nodiscard]] static Quadric line(const Vec3& direction, const Vec3& point, double weight);

    [[nodiscard]] double error(const Vec3& x) const {
        return x.x() * (xx * x.x() + 2 * (xy * x.y() + xz * x.z() + b.x())) + x.y() * (yy * x.y() + 2 * (yz * x.z() + b.y())) +
               x.z() * (zz * x.z() + 2 * b.z()) + c;
    }

    [[nodiscard]] double trace() const { return xx + yy + zz; }

    /// A x + b: half the gradient at x.
    [[nodiscard]] Vec3 half_gradient(const Vec3& x) const { return times(x) + b; }

    /// A x.
    [[nodiscard]] Vec3 times(const Vec3& x) const {
        return {xx * x.x() + xy * x.y() + xz * x.z(), xy * x.x() + yy * x.y() + yz * x.z(), xz * x.x() + yz * x.y() + zz * x.z()};
    }

    Quadric& operator+=(const Quadric& other) {
        xx += other.xx;
        xy += other.xy;
        xz += other.xz;
        yy += other.yy;
        yz += other.yz;
        zz += other.zz;
        b += other.b;
        c += other.c;
        return *this;
    }
    friend Quadric operator+(Quadric left, const Quadric& right) { return left += right; }
};

}  // namespace vsplit
