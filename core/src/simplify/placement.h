#pragma once

#include <Eigen/Dense>
#include <optional>

#include "vsplit/simplify/quadric.h"

namespace vsplit {

/// `from` moved towards the minimum of the quadric, only in the directions in which it is curved: on a plane along the normal,
/// on a crease across it. (A + eps tr(A) I)(x - from) = -(b + A from), the regularised form of the projection with pinv(A) that
/// the paper lacks; without it nothing on a plane or along a crease has a second candidate.
[[nodiscard]] inline Vec3 project_to_minimum(const Quadric& q, const Vec3& from) {
    constexpr double kRegularisation = 1e-3;
    const double eps = kRegularisation * q.trace();
    if (!(eps > 0)) return from;
    Eigen::Matrix3d a;
    a << q.xx + eps, q.xy, q.xz, q.xy, q.yy + eps, q.yz, q.xz, q.yz, q.zz + eps;
    return from - a.inverse() * q.half_gradient(from);
}

/// The quadric's minimum -A^-1 b ([Date05] 4.2.1, [GH97]) where A is well conditioned.
[[nodiscard]] inline std::optional<Vec3> minimum(const Quadric& q) {
    constexpr double kLeastDeterminant = 1e-4;  // relative to that of a multiple of the identity
    const double mean = q.trace() / 3;
    Eigen::Matrix3d a;
    a << q.xx, q.xy, q.xz, q.xy, q.yy, q.yz, q.xz, q.yz, q.zz;
    Eigen::Matrix3d inverse;
    bool invertible = false;
    a.computeInverseWithCheck(inverse, invertible, kLeastDeterminant * mean * mean * mean);
    if (!invertible || !(mean > 0)) return std::nullopt;
    return Vec3(-(inverse * q.b));
}

}  // namespace vsplit
