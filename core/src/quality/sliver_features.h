#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "features/crease_marks.h"

namespace vsplit {

/// A face by its longest edge.
struct SliverFace {
    HalfEdge longest = kNone;
    HalfEdge shortest = kNone;
    double length = 0;  ///< of the longest edge
    double wanted = 0;  ///< the same, or the length of edges wanted where that is less
    double stretch = 0;
};

/// Which creases force a face to have a stretch under the floor. Each question: what it asks for, where that holds.
class SliverFeatures {
public:
    /// Both must outlive this.
    SliverFeatures(const TriangleMesh& mesh, const CreaseMarks& marks) : mesh_(mesh), marks_(marks) {}

    /// The angle, in degrees, of the sector between two creases that the face lies in.
    [[nodiscard]] std::optional<double> sharp_corner(const SliverFace& face) const;
    /// The distance of the two creases it lies between, or that its shortest edge or its height joins.
    [[nodiscard]] std::optional<double> narrow_strip(const SliverFace& face) const;
    /// The distance of the two corners that its shortest edge joins.
    [[nodiscard]] std::optional<double> close_corners(const SliverFace& face) const;
    /// The girth of the part there: how far it is around it, across the longest edge. Two points of that cut are at most half of
    /// it apart, and so is a face's height.
    [[nodiscard]] std::optional<double> narrow_part(const SliverFace& face) const;

private:
    using Vertices = std::vector<std::uint32_t>;

    [[nodiscard]] double sector(HalfEdge corner, double limit) const;
    /// The other ends of the creases at the origin of h.
    [[nodiscard]] Vertices crease_neighbours(HalfEdge h) const;
    [[nodiscard]] bool is_corner(HalfEdge h) const;
    [[nodiscard]] bool joined(HalfEdge edge) const;
    [[nodiscard]] const Vec3& position(std::uint32_t v) const { return mesh_.positions[v]; }

    const TriangleMesh& mesh_;
    const CreaseMarks& marks_;
};

}  // namespace vsplit
