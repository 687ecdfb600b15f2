#include "shapes/circle.h"

#include <Eigen/Dense>
#include <cmath>

namespace vsplit {

std::optional<Circle> fit_circle(std::span<const Eigen::Vector2d> points, std::span<const double> weights) {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Eigen::Vector2d& p = points[i];
        const Eigen::Vector3d row(2 * p.x(), 2 * p.y(), 1);
        const double weight = weights.empty() ? 1 : weights[i];
        normal += weight * row * row.transpose();
        right += weight * row * p.squaredNorm();
    }
    const Eigen::Vector3d found = normal.ldlt().solve(right);
    const double squared = found[2] + found[0] * found[0] + found[1] * found[1];
    if (!(squared > 0) || !found.allFinite()) return {};
    return Circle{{found[0], found[1]}, std::sqrt(squared)};
}

}  // namespace vsplit
