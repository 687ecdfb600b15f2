#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

namespace vsplit {

struct Circle {
    Eigen::Vector2d centre = Eigen::Vector2d::Zero();
    double radius = 0;
};

/// The circle through points by least squares of |p|^2 = 2 p.c + (r^2 - |c|^2) (Kasa 1976); none where they are on a line.
/// \param weights of the points, >= 0; empty: all count the same.
/// \pre the origin is near the points; as many weights as points, or none. O(points).
[[nodiscard]] std::optional<Circle> fit_circle(std::span<const Eigen::Vector2d> points, std::span<const double> weights = {});

}  // namespace vsplit
