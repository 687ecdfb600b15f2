#include "simplify/deviation_guard.h"

#include <array>
#include <cmath>
#include <limits>

namespace vsplit {

DeviationGuard::DeviationGuard(const HalfEdgeMesh& mesh, const SurfaceIndex& source, double limit)
    : source_(source),
      limit_(limit),
      limit_square_(limit * limit),
      points_(mesh.vertex_count()),
      next_(mesh.vertex_count(), kNone),
      first_(mesh.half_edge_count() / 3, kNone) {
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        if (mesh.outgoing(v) == kNone) continue;
        points_[v] = mesh.position(v);
        std::uint32_t& first = first_[face_of(mesh.outgoing(v))];
        next_[v] = first;
        first = v;
    }
}

bool DeviationGuard::near_source(const Vec3& p) const {
    return source_.closest(p, limit_square_).element != SurfaceIndex::kNoElement;
}

bool DeviationGuard::stays_in_plane(const NewFace& f) const {
    constexpr double kNothing = 1e-3;  // of the limit
    return f.old_normal != Vec3::Zero() && std::abs(f.old_normal.dot(f.apex - f.b)) <= kNothing * limit_;
}

bool DeviationGuard::reaches_source(std::span<const NewFace> faces) const {
    bool apex_tried = false;
    for (const NewFace& f : faces) {
        if (stays_in_plane(f)) continue;
        if (!apex_tried && !near_source(f.apex)) return false;
        apex_tried = true;
        if (!near_source((f.apex + f.b) / 2) || !near_source((f.apex + f.b + f.c) / 3)) return false;
    }
    return true;
}

bool DeviationGuard::reached_by_source(std::span<const std::uint32_t> old_faces, std::span<const NewFace> faces) {
    const double on_the_face = 1e-6 * limit_square_;
    places_.clear();
    for (const std::uint32_t old : old_faces) {
        for (std::uint32_t point = first_[old]; point != kNone; point = next_[point]) {
            double nearest = std::numeric_limits<double>::infinity();
            std::uint32_t place = kNone;
            for (const NewFace& f : faces) {
                const double square = TriangleShape{{f.apex, f.b, f.c}}.closest(points_[point]).squared_distance;
                if (!(square < nearest)) continue;
                nearest = square;
                place = f.face;
                if (square <= on_the_face) break;
            }
            if (!(nearest <= limit_square_)) return false;
            places_.push_back({point, place});
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
