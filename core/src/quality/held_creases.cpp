#include "quality/held_creases.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "spatial/surface_index.h"

namespace vsplit {
namespace {

/// Of the reach, from one point to the next: what lies between is at most half of that further, and so within 4/3 of it.
constexpr double kStep = 2.0 / 3;
constexpr double kMostPointsAnEdge = 1024;

std::vector<Vec3> points_along(const TriangleMesh& source, const std::vector<SharpEdge>& creases, double step) {
    std::vector<Vec3> points;
    for (const SharpEdge& crease : creases) {
        const Vec3 &a = source.positions[crease.a], &b = source.positions[crease.b];
        const auto count = static_cast<int>(std::clamp(std::ceil((b - a).norm() / step), 1.0, kMostPointsAnEdge));
        for (int n = 0; n < count; ++n) points.emplace_back(a + (b - a) * ((n + 0.5) / count));
    }
    return points;
}

}  // namespace

HeldCreases::HeldCreases(const TriangleMesh& mesh, const CreaseMarks& marks, const TriangleMesh& source,
                         const std::vector<SharpEdge>& creases, double reach)
    : marks_(marks), reach_square_(reach * reach), first_(marks.half_edge_count() + 1, 0) {
    std::vector<HalfEdge> edges;
    std::vector<EdgeEnds> ends;
    for (HalfEdge h = 0; h < marks.half_edge_count(); ++h) {
        if (marks.edge_of(h) != h || !marks.marked(h)) continue;
        edges.push_back(h);
        ends.push_back({origin(mesh, h), origin(mesh, next(h))});
    }
    const CreaseIndex index = crease_index(mesh.positions, ends);
    std::vector<std::pair<HalfEdge, Vec3>> placed;
    for (const Vec3& p : points_along(source, creases, kStep * reach)) {
        const CreaseIndex::Hit hit = index.closest(p, reach_square_);
        if (hit.element != CreaseIndex::kNoElement) placed.emplace_back(edges[hit.element], p);
    }
    for (const auto& [edge, point] : placed) ++first_[edge + 1];
    for (std::size_t edge = 1; edge < first_.size(); ++edge) first_[edge] += first_[edge - 1];
    std::vector<std::uint32_t> to(first_.begin(), first_.end() - 1);
    points_.resize(placed.size());
    for (const auto& [edge, point] : placed) points_[to[edge]++] = point;
}

bool HeldCreases::may_become(std::span<const HalfEdge> before, std::span<const SegmentShape> after) const {
    const auto is_reached = [&](const Vec3& point) {
        return std::any_of(after.begin(), after.end(),
                           [&](const SegmentShape& crease) { return crease.closest(point).squared_distance <= reach_square_; });
    };
    return std::all_of(before.begin(), before.end(), [&](HalfEdge h) {
        const HalfEdge edge = marks_.edge_of(h);
        const auto begin = points_.begin();
        return std::all_of(begin + first_[edge], begin + first_[edge + 1], is_reached);
    });
}

}  // namespace vsplit
