#include "repair/loop_triangulation.h"

#include <Eigen/Geometry>
#include <limits>
#include <utility>

namespace vsplit {
namespace {

constexpr double kForbidden = std::numeric_limits<double>::infinity();

/// Least area of the part of the polygon between two corners, and the corner that its triangle on their chord has.
struct Table {
    explicit Table(std::size_t corners) : count(corners), area(corners * corners, 0), apex(corners * corners, 0) {}
    [[nodiscard]] std::size_t at(std::size_t i, std::size_t j) const { return i * count + j; }

    std::size_t count;
    std::vector<double> area;
    std::vector<std::uint32_t> apex;
};

double area_of(const Vec3& a, const Vec3& b, const Vec3& c) { return (b - a).cross(c - a).norm() / 2; }

void fill(Table& table, std::span<const Vec3> corners, std::size_t from, std::size_t to) {
    double least = kForbidden;
    for (std::size_t k = from + 1; k < to; ++k) {
        const double parts = table.area[table.at(from, k)] + table.area[table.at(k, to)];
        if (parts >= least) continue;
        const double area = parts + area_of(corners[from], corners[k], corners[to]);
        if (area >= least) continue;
        least = area;
        table.apex[table.at(from, to)] = static_cast<std::uint32_t>(k);
    }
    table.area[table.at(from, to)] = least;
}

}  // namespace

std::vector<Triangle> triangulate_loop(std::span<const Vec3> corners,
                                       const std::function<bool(std::uint32_t, std::uint32_t)>& allowed) {
    const std::size_t n = corners.size();
    Table table(n);
    for (std::size_t span = 2; span < n; ++span) {
        for (std::size_t from = 0; from + span < n; ++from) {
            const std::size_t to = from + span;
            const bool chord = span < n - 1;  // the first and the last corner have a side between them
            if (chord && !allowed(static_cast<std::uint32_t>(from), static_cast<std::uint32_t>(to))) {
                table.area[table.at(from, to)] = kForbidden;
            } else {
                fill(table, corners, from, to);
            }
        }
    }
    if (table.area[table.at(0, n - 1)] == kForbidden) return {};
    std::vector<Triangle> triangles;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> open{{0U, static_cast<std::uint32_t>(n - 1)}};
    while (!open.empty()) {
        const auto [from, to] = open.back();
        open.pop_back();
        if (to - from < 2) continue;
        const std::uint32_t apex = table.apex[table.at(from, to)];
        triangles.push_back({from, apex, to});
        open.emplace_back(apex, to);
        open.emplace_back(from, apex);
    }
    return triangles;
}

}  // namespace vsplit
