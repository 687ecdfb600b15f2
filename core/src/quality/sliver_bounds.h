#pragma once

#include <cmath>

#include "quality/face_shape.h"

namespace vsplit {

// With the longest edge 1, what a triangle needs to reach a stretch s, 0 < s < 1. From St = sqrt(12) * twice the area /
// (perimeter
// * longest), which is largest for the isosceles triangle in each case.

/// Its least height: sqrt(12) h / (1 + sqrt(1 + 4 h^2)) = s.
[[nodiscard]] inline double height_for_stretch(double s) { return kSqrt12 * s / (6 - 2 * s * s); }

/// Its shortest edge, 2 t with sqrt(12) t sqrt((1 - t) / (1 + t)) = s; opposite to it is the smallest angle, 2 asin(t). Both
/// grow with the stretch, so what has less of either has less stretch.
[[nodiscard]] inline double short_edge_for_stretch(double s) {
    double low = 0, high = 0.5;  // equilateral
    for (int step = 0; step < 60; ++step) {
        const double t = (low + high) / 2;
        (kSqrt12 * t * std::sqrt((1 - t) / (1 + t)) < s ? low : high) = t;
    }
    return 2 * high;
}

/// Its smallest angle, radians.
[[nodiscard]] inline double angle_for_stretch(double s) { return 2 * std::asin(short_edge_for_stretch(s) / 2); }

}  // namespace vsplit
