#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "simplify/border_guard.h"
#include "simplify/half_edge_mesh.h"
#include "spatial/surface_index.h"

namespace vsplit {

/// Keeps the mesh within a distance of the source and the source within it of the mesh, while faces are replaced by others.
///
/// Points of the source, the vertices of the dense mesh, are kept at a face that is near: where faces are replaced, theirs go
/// over to the new ones, as in the error control of Klein, Liebich and Strasser (Mesh Reduction with Error Control, 1996). New
/// faces are tried at their apex, their middle and the middle of one side, long ones and fins at more places. Both are samples:
/// the limit is to be a little under what is promised, and the result is measured afterwards (`measure_deviation`).
///
/// A copy keeps the same points, not others: two may be used at the same time, each for faces that the other has nothing to do
/// with.
class DeviationGuard {
public:
    /// A face as it would be. Its side (b, c) was there before, in a face of normal `old_normal` (unit, or zero when not known):
    /// where the apex lies in the plane of that face the surface stays, and nothing need be tried.
    struct NewFace {
        std::uint32_t face = 0;
        Vec3 apex = Vec3::Zero();
        Vec3 b = Vec3::Zero();
        Vec3 c = Vec3::Zero();
        Vec3 old_normal = Vec3::Zero();
    };

    /// Of the vertices about `most_points` are kept, evenly spread. Boundaries are guarded too, ghosts and their faces are not.
    /// \pre `mesh` is the dense mesh, whose surface is the source's; `source` outlives this.
    DeviationGuard(const HalfEdgeMesh& mesh, const SurfaceIndex& source, double limit, std::uint32_t most_points = kNone,
                   const Border& border = {});

    /// The guard of the open boundaries; null without any.
    [[nodiscard]] BorderGuard* border() const { return border_.get(); }

    /// Whether `faces` may stand where those of `old_faces` are; if so their points go over to them. O(faces * points of them).
    [[nodiscard]] bool replace(std::span<const std::uint32_t> old_faces, std::span<const NewFace> faces);

private:
    struct Place {
        std::uint32_t point = 0;
        std::uint32_t face = 0;
    };

    struct Nearest {
        std::size_t number = 0;
        double square = std::numeric_limits<double>::infinity();
    };

    [[nodiscard]] Nearest nearest_face(const Vec3& point, std::size_t guess) const;
    [[nodiscard]] bool stays_in_plane(const NewFace& f) const;
    [[nodiscard]] int steps_along(double length, double step) const;
    [[nodiscard]] bool is_near_source(const Vec3& point);
    [[nodiscard]] bool inside_reaches_source(const NewFace& f, bool stays, double step);
    [[nodiscard]] bool reaches_source(std::span<const NewFace> faces);
    [[nodiscard]] bool reached_by_source(std::span<const std::uint32_t> old_faces, std::span<const NewFace> faces);

    /// By number, each at a face or at none.
    struct Points {
        std::vector<Vec3> at;
        std::vector<std::uint32_t> next;   // of a point: the next one at its face, or kNone
        std::vector<std::uint32_t> first;  // of a face: its first point, or kNone
    };

    std::shared_ptr<BorderGuard> border_;
    const SurfaceIndex& source_;
    const double limit_;
    const double limit_square_;
    std::shared_ptr<Points> points_;
    std::uint32_t near_face_ = kNone;       // of the source: the one found last
    std::vector<PreparedTriangle> shapes_;  // of the new faces
    std::vector<Place> places_;             // where the points of old faces would go
};

}  // namespace vsplit
