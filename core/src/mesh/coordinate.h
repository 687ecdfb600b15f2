#pragma once

#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// Beyond this, rounding eats the digits that areas and volumes are made of, and far beyond it squares become infinite.
inline constexpr double kLargestCoordinate = 1e15;

/// Whether a mesh may hold this coordinate; false for NaN. Every way into the program asks this.
[[nodiscard]] inline bool is_valid_coordinate(double value) {
    return value <= kLargestCoordinate && value >= -kLargestCoordinate;
}

[[nodiscard]] inline bool is_valid_position(const Vec3& position) {
    return is_valid_coordinate(position.x()) && is_valid_coordinate(position.y()) && is_valid_coordinate(position.z());
}

}  // namespace vsplit
