#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "vsplit/method/method_options.h"

namespace vsplit::test {

/// What breaks each bound of `options` on a closed mesh, by name, counted from the definitions without the engine's help: angles
/// by arc tangents, valences by distinct neighbours. A bound counts as broken beyond `slack`, relative.
inline std::map<std::string, std::vector<std::uint32_t>> broken_bounds(const TriangleMesh& mesh, const ControlOptions& options,
                                                                       double slack) {
    std::map<std::string, std::vector<std::uint32_t>> broken;
    const auto least = [&](const char* name, const std::optional<double>& limit, double value, std::uint32_t element) {
        if (limit && value < *limit * (1 - slack)) broken[name].push_back(element);
    };
    const auto most = [&](const char* name, const std::optional<double>& limit, double value, std::uint32_t element) {
        if (limit && value > *limit * (1 + slack)) broken[name].push_back(element);
    };
    std::vector<std::vector<std::uint32_t>> neighbours(mesh.positions.size());
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        const Triangle& t = mesh.faces[f];
        std::array<double, 3> sides{}, angles{};
        double perimeter = 0, area = 0;
        for (int i = 0; i < 3; ++i) {
            const Vec3 &p = mesh.positions[t[i]], &q = mesh.positions[t[(i + 1) % 3]], &r = mesh.positions[t[(i + 2) % 3]];
            sides[i] = (q - p).norm();
            perimeter += sides[i];
            area = (q - p).cross(r - p).norm() / 2;
            angles[i] = std::atan2(2 * area, (q - p).dot(r - p)) * 57.29577951308232;
            neighbours[t[i]].push_back(t[(i + 1) % 3]);
        }
        std::sort(sides.begin(), sides.end());
        std::sort(angles.begin(), angles.end());
        least("min_stretch", options.min_stretch, 2 * std::sqrt(12) * area / (perimeter * sides[2]), f);
        most("max_size", options.max_size, sides[2], f);
        least("min_angle", options.min_angle, angles[0], f);
        most("max_angle", options.max_angle, angles[2], f);
        most("max_aspect_ratio", options.max_aspect_ratio, sides[2] / sides[0], f);
        least("min_size", options.min_size, sides[2], f);
    }
    for (std::uint32_t v = 0; options.max_valence && v < mesh.vertex_count(); ++v) {
        std::sort(neighbours[v].begin(), neighbours[v].end());
        const auto last = std::unique(neighbours[v].begin(), neighbours[v].end());
        if (last - neighbours[v].begin() > std::ptrdiff_t{*options.max_valence}) broken["max_valence"].push_back(v);
    }
    return broken;
}

}  // namespace vsplit::test
