#pragma once

#include <algorithm>
#include <cmath>

#include "spatial/surface_index.h"

namespace vsplit::test {

/// The largest distance to `to` of points spread over every face of `from`: `steps` to a side.
[[nodiscard]] inline double sampled_deviation(const TriangleMesh& from, const TriangleMesh& to, int steps) {
    const SurfaceIndex index = surface_index(to);
    double largest = 0;
    for (const Triangle& t : from.faces) {
        for (int i = 0; i <= steps; ++i) {
            for (int j = 0; i + j <= steps; ++j) {
                const Vec3 p =
                    (from.positions[t[0]] * i + from.positions[t[1]] * j + from.positions[t[2]] * (steps - i - j)) / steps;
                largest = std::max(largest, index.closest(p).squared_distance);
            }
        }
    }
    return std::sqrt(largest);
}

}  // namespace vsplit::test
