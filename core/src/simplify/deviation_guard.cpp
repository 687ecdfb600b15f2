#include "simplify/deviation_guard.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vsplit {
namespace {

/// A face at v that is no ghost's.
std::uint32_t visible_face(const HalfEdgeMesh& mesh, const Border& border, std::uint32_t v) {
    HalfEdge h = mesh.outgoing(v);
    while (border.is_ghost(mesh.target(h)) || border.is_ghost(mesh.origin(prev(h)))) h = mesh.turn(h);
    return face_of(h);
}

}  // namespace

DeviationGuard::DeviationGuard(const HalfEdgeMesh& mesh, const SurfaceIndex& source, double limit, std::uint32_t most_points,
                               const Border& border)
    : border_(border.empty() ? nullptr : std::make_unique<BorderGuard>(mesh, border, limit)),
      source_(source),
      limit_(limit),
      limit_square_(limit * limit),
      points_(mesh.vertex_count()),
      next_(mesh.vertex_count(), kNone),
      first_(mesh.half_edge_count() / 3, kNone) {
    // Vertices are numbered along a curve through space, so every n-th of them are spread evenly.
    const std::uint32_t stride = 1 + mesh.vertex_count() / std::max(most_points, 1U);
    for (std::uint32_t v = 0; v < mesh.vertex_count(); v += stride) {
        if (mesh.outgoing(v) == kNone || border.is_ghost(v)) continue;
        points_[v] = mesh.position(v);
        std::uint32_t& first = first_[visible_face(mesh, border, v)];
        next_[v] = first;
        first = v;
    }
}

bool DeviationGuard::stays_in_plane(const NewFace& f) const {
    constexpr double kNothing = 1e-3;  // of the limit
    return f.old_normal != Vec3::Zero() && std::abs(f.old_normal.dot(f.apex - f.b)) <= kNothing * limit_;
}

/// Points that are tried one after the other are mostly near the same face of the source.
bool DeviationGuard::is_near_source(const Vec3& point) { return source_.within(point, limit_, near_face_); }

bool DeviationGuard::inside_reaches_source(const NewFace& f) {
    const Vec3 side = (f.b + f.c) / 2;
    const int steps = steps_along(std::max((f.apex - f.b).norm(), (f.apex - side).norm()));
    if (steps == 0 && stays_in_plane(f)) return true;
    if (!is_near_source((f.apex + f.b) / 2) || !is_near_source((f.apex + f.b + f.c) / 3)) return false;
    for (int n = 0; n < steps; ++n) {
        const double share = (n + 0.5) / steps;
        if (!is_near_source(f.apex + share * (f.b - f.apex)) || !is_near_source(side + share * (f.apex - side))) return false;
    }
    return true;
}

/// Samples along so long a line beside those that every face has.
int DeviationGuard::steps_along(double length) const {
    constexpr double kLong = 32;  // limits
    constexpr double kMostSteps = 32;
    return length > kLong * limit_ ? static_cast<int>(std::min(std::ceil(length / (kLong * limit_)), kMostSteps)) : 0;
}

bool DeviationGuard::reaches_source(std::span<const NewFace> faces) {
    bool apex_tried = false;
    for (const NewFace& f : faces) {
        if (!apex_tried && !stays_in_plane(f)) {
            if (!is_near_source(f.apex)) return false;
            apex_tried = true;
        }
        if (!inside_reaches_source(f)) return false;
    }
    return true;
}

/// The nearest of the faces to a point, or the first one found that is near enough, beginning with number `guess`.
DeviationGuard::Nearest DeviationGuard::nearest_face(const Vec3& point, std::size_t guess) const {
    constexpr double kNearEnough = 0.01;  // of the limit squared
    Nearest nearest;
    for (std::size_t tried = 0, n = guess; tried < shapes_.size(); ++tried, n = n + 1 == shapes_.size() ? 0 : n + 1) {
        const double square = shapes_[n].squared_distance(point, nearest.square);
        if (square < nearest.square) nearest = {n, square};
        if (square <= kNearEnough * limit_square_) break;
    }
    return nearest;
}

bool DeviationGuard::reached_by_source(std::span<const std::uint32_t> old_faces, std::span<const NewFace> faces) {
    places_.clear();
    shapes_.clear();
    for (const NewFace& f : faces) shapes_.emplace_back(TriangleShape{{f.apex, f.b, f.c}});
    std::size_t guess = 0;  // points of a face are near each other
    for (const std::uint32_t old : old_faces) {
        for (std::uint32_t point = first_[old]; point != kNone; point = next_[point]) {
            const Nearest nearest = nearest_face(points_[point], guess);
            if (!(nearest.square <= limit_square_)) return false;
            guess = nearest.number;
            places_.push_back({point, faces[guess].face});
        }
    }
    return true;
}

bool DeviationGuard::replace(std::span<const std::uint32_t> old_faces, std::span<const NewFace> faces) {
    if (!reached_by_source(old_faces, faces) || !reaches_source(faces)) return false;
    for (const std::uint32_t old : old_faces) first_[old] = kNone;
    for (const Place& place : places_) {
        next_[place.point] = first_[place.face];
        first_[place.face] = place.point;
    }
    return true;
}

}  // namespace vsplit
