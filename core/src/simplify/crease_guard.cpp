#include "simplify/crease_guard.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "spatial/surface_index.h"

namespace vsplit {
namespace {

/// Limits, from one point of an edge of the dense mesh to the next: what lies between is at most half of that further, and so
/// within the bound of which the limit is three quarters (`run_policy`).
constexpr double kStep = 2.0 / 3;
constexpr double kMostPointsAnEdge = 1024;  // an edge so long has points further apart

double square_distance(const Vec3& p, const Vec3& a, const Vec3& b) {
    const Vec3 along = b - a;
    const double length_square = along.squaredNorm();
    const double share = length_square > 0 ? std::clamp((p - a).dot(along) / length_square, 0.0, 1.0) : 0;
    return (p - (a + share * along)).squaredNorm();
}

}  // namespace

CreaseGuard::CreaseGuard(const HalfEdgeMesh& mesh, const std::vector<SharpEdge>& creases, double limit)
    : limit_(limit), points_(std::make_shared<Points>()) {
    points_->first.assign(mesh.half_edge_count(), kNone);
    for (const SharpEdge& crease : creases) {
        mesh.for_each_outgoing(crease.a, [&](HalfEdge h) {
            if (mesh.target(h) == crease.b) add(mesh.edge_of(h), mesh.position(crease.a), mesh.position(crease.b));
        });
    }
}

void CreaseGuard::add(HalfEdge edge, const Vec3& a, const Vec3& b) {
    const auto count = static_cast<int>(std::clamp(std::ceil((b - a).norm() / (kStep * limit_)), 1.0, kMostPointsAnEdge));
    for (int n = 0; n < count; ++n) {
        points_->at.push_back(a + (b - a) * ((n + 0.5) / count));
        points_->next.push_back(kNone);
        put({static_cast<std::uint32_t>(points_->at.size() - 1), edge});
    }
}

bool CreaseGuard::place(std::uint32_t point, std::span<const NewCrease> creases) {
    double least = std::numeric_limits<double>::infinity();
    HalfEdge edge = kNone;
    for (const NewCrease& crease : creases) {
        const double square = square_distance(points_->at[point], crease.a, crease.b);
        if (!(square < least)) continue;
        least = square;
        edge = crease.edge;
    }
    if (!(least <= limit_ * limit_)) return false;
    places_.push_back({point, edge});
    return true;
}

bool CreaseGuard::admits(std::span<const HalfEdge> old_edges, std::span<const NewCrease> creases) {
    places_.clear();
    for (const HalfEdge edge : old_edges) {
        for (std::uint32_t point = points_->first[edge]; point != kNone; point = points_->next[point]) {
            if (!place(point, creases)) return false;
        }
    }
    return true;
}

void CreaseGuard::go_to_nearest(const std::vector<NewCrease>& creases) {
    std::vector<Vec3> ends;
    std::vector<EdgeEnds> edges;
    for (const NewCrease& crease : creases) {
        const auto first = static_cast<std::uint32_t>(ends.size());
        ends.push_back(crease.a);
        ends.push_back(crease.b);
        edges.push_back({first, first + 1});
    }
    const CreaseIndex index = crease_index(ends, edges);
    places_.clear();
    for (HalfEdge edge = 0; edge < points_->first.size(); ++edge) {
        for (std::uint32_t point = std::exchange(points_->first[edge], kNone); point != kNone; point = points_->next[point]) {
            const CreaseIndex::Hit hit = index.closest(points_->at[point], limit_ * limit_);
            places_.push_back({point, hit.element == CreaseIndex::kNoElement ? edge : creases[hit.element].edge});
        }
    }
    for (const Place& at : places_) put(at);
}

void CreaseGuard::commit(std::span<const HalfEdge> old_edges) {
    for (const HalfEdge edge : old_edges) points_->first[edge] = kNone;
    for (const Place& at : places_) put(at);
}

}  // namespace vsplit
