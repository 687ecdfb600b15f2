#include "simplify/deviation_guard.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace vsplit {
namespace {

constexpr double kStep = 32;         // limits, from one sample of a long line to the next
constexpr double kFinStep = 1;       // the same along the edge of a fin
constexpr double kFinCosine = -0.8;  // of the normals on either side of that: nearly back to back

/// As long as twice the area.
Vec3 normal_of(const DeviationGuard::NewFace& f) { return (f.b - f.apex).cross(f.c - f.apex); }

bool makes_fin(const Vec3& normal, const Vec3& other) {
    const double product = normal.dot(other);
    return product < 0 && product * product > kFinCosine * kFinCosine * normal.squaredNorm() * other.squaredNorm();
}

/// A face at v that is no ghost's.
std::uint32_t visible_face(const HalfEdgeMesh& mesh, const Border& border, std::uint32_t v) {
    HalfEdge h = mesh.outgoing(v);
    while (border.is_ghost(mesh.target(h)) || border.is_ghost(mesh.origin(prev(h)))) h = mesh.turn(h);
    return face_of(h);
}

}  // namespace

DeviationGuard::DeviationGuard(const HalfEdgeMesh& mesh, const SurfaceIndex& source, double limit, std::uint32_t most_points,
                               const Border& border)
    : border_(border.empty() ? nullptr : std::make_shared<BorderGuard>(mesh, border, limit)),
      source_(source),
      limit_(limit),
      limit_square_(limit * limit),
      points_(std::make_shared<Points>()) {
    points_->at.resize(mesh.vertex_count());
    points_->next.assign(mesh.vertex_count(), kNone);
    points_->first.assign(mesh.half_edge_count() / 3, kNone);
    // Vertices are numbered along a curve through space, so every n-th of them are spread evenly.
    const std::uint32_t stride = 1 + mesh.vertex_count() / std::max(most_points, 1U);
    for (std::uint32_t v = 0; v < mesh.vertex_count(); v += stride) {
        if (mesh.outgoing(v) == kNone || border.is_ghost(v)) continue;
        points_->at[v] = mesh.position(v);
        std::uint32_t& first = points_->first[visible_face(mesh, border, v)];
        points_->next[v] = first;
        first = v;
    }
}

bool DeviationGuard::stays_in_plane(const NewFace& f) const {
    constexpr double kNothing = 1e-3;  // of the limit
    return f.old_normal != Vec3::Zero() && std::abs(f.old_normal.dot(f.apex - f.b)) <= kNothing * limit_;
}

/// Points that are tried one after the other are mostly near the same face of the source.
bool DeviationGuard::is_near_source(const Vec3& point) { return source_.within(point, limit_, near_face_); }

bool DeviationGuard::inside_reaches_source(const NewFace& f, bool stays, double step) {
    const Vec3 side = (f.b + f.c) / 2;
    const int steps = steps_along(std::max((f.apex - f.b).norm(), (f.apex - side).norm()), step);
    if (steps == 0 && stays) return true;
    if (!is_near_source((f.apex + f.b) / 2) || !is_near_source((f.apex + f.b + f.c) / 3)) return false;
    for (int n = 0; n < steps; ++n) {
        const double share = (n + 0.5) / steps;
        if (!is_near_source(f.apex + share * (f.b - f.apex)) || !is_near_source(side + share * (f.apex - side))) return false;
    }
    return true;
}

/// Samples along so long a line beside those that every face has, one each `step` limits; none where it is no longer.
int DeviationGuard::steps_along(double length, double step) const {
    constexpr double kMostSteps = 32;
    return length > step * limit_ ? static_cast<int>(std::min(std::ceil(length / (step * limit_)), kMostSteps)) : 0;
}

/// A face that stays in its plane may yet grow beyond what was there: over the side it shares with one that leaves its own plane,
/// and where two lie back to back, as those of a fin do. That side is the first of a face, which belongs to it and the one
/// before.
bool DeviationGuard::reaches_source(std::span<const NewFace> faces) {
    if (faces.empty()) return true;
    bool apex_tried = false;
    bool before_stays = stays_in_plane(faces.back());
    Vec3 normal_before = normal_of(faces.back());
    for (const NewFace& f : faces) {
        const bool stays = stays_in_plane(f);
        if (!apex_tried && !stays) {
            if (!is_near_source(f.apex)) return false;
            apex_tried = true;
        }
        const Vec3 normal = normal_of(f);
        const bool fin = makes_fin(normal, normal_before);
        if (!inside_reaches_source(f, stays && before_stays && !fin, fin ? kFinStep : kStep)) return false;
        before_stays = stays;
        normal_before = normal;
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
        for (std::uint32_t point = points_->first[old]; point != kNone; point = points_->next[point]) {
            const Nearest nearest = nearest_face(points_->at[point], guess);
            if (!(nearest.square <= limit_square_)) return false;
            guess = nearest.number;
            places_.push_back({point, faces[guess].face});
        }
    }
    return true;
}

bool DeviationGuard::replace(std::span<const std::uint32_t> old_faces, std::span<const NewFace> faces) {
    if (!reached_by_source(old_faces, faces) || !reaches_source(faces)) return false;
    for (const std::uint32_t old : old_faces) points_->first[old] = kNone;
    for (const Place& place : places_) {
        points_->next[place.point] = points_->first[place.face];
        points_->first[place.face] = place.point;
    }
    return true;
}

}  // namespace vsplit
