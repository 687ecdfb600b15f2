#include "shapes/circle.h"

#include <Eigen/Dense>
#include <cmath>

namespace vsplit {

std::optional<Circle> fit_circle(std::span<const Eigen::Vector2d> points) {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (const Eigen::Vector2d& p : points) {
        const Eigen::Vector3d row(2 * p.x(), 2 * p.y(), 1);
        normal += row * row.transpose();
        right += row * p.squaredNorm();
    }
    const Eigen::Vector3d found = normal.ldlt().solve(right);
    const double squared = found[2] + found[0] * found[0] + found[1] * found[1];
    if (!(squared > 0) || !found.allFinite()) return {};
    return Circle{{found[0], found[1]}, std::sqrt(squared)};
}

}  // namespace vsplit
