#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "simplify/half_edge_mesh.h"
#include "vsplit/features/sharp_edges.h"

namespace vsplit {

/// Keeps the source's creases within a distance of the mesh's, while edges are replaced by others.
///
/// Points along the source's creases are kept at a crease of the mesh that is near: where that goes, or is sharp no longer, they
/// go over to one of those about, or else it may not go. So thin steps and grooves do not go flat, however little the surface
/// would move. Samples, as with DeviationGuard, and as there a copy keeps the same points.
class CreaseGuard {
public:
    /// A crease as it would be.
    struct NewCrease {
        HalfEdge edge = 0;  ///< the number it would go by
        Vec3 a = Vec3::Zero();
        Vec3 b = Vec3::Zero();
    };

    /// \pre `creases` are edges of `mesh`, marked there.
    CreaseGuard(const HalfEdgeMesh& mesh, const std::vector<SharpEdge>& creases, double limit);

    /// Whether `creases` may stand where those numbered `old_edges` are. O(creases * points of the old).
    [[nodiscard]] bool admits(std::span<const HalfEdge> old_edges, std::span<const NewCrease> creases);

    /// Has the points go over as the last `admits` found, which was of `old_edges`. \pre it said yes.
    void commit(std::span<const HalfEdge> old_edges);

    /// Has each point go over to the nearest of `creases` that is within the limit; one that has none near stays where it is.
    /// What a point was handed on to need not be what is nearest to it now. O((creases + points) log creases).
    void go_to_nearest(const std::vector<NewCrease>& creases);

    [[nodiscard]] bool holds_points(HalfEdge edge) const { return points_->first[edge] != kNone; }

private:
    struct Place {
        std::uint32_t point = 0;
        HalfEdge edge = 0;
    };

    void add(HalfEdge edge, const Vec3& a, const Vec3& b);
    [[nodiscard]] bool place(std::uint32_t point, std::span<const NewCrease> creases);
    void put(Place at) {
        points_->next[at.point] = points_->first[at.edge];
        points_->first[at.edge] = at.point;
    }

    struct Points {
        std::vector<Vec3> at;
        std::vector<std::uint32_t> next;   // of a point: the next one at its edge, or kNone
        std::vector<std::uint32_t> first;  // of an edge, by its number: its first point, or kNone
    };

    const double limit_;
    std::shared_ptr<Points> points_;
    std::vector<Place> places_;  // where the points of old edges would go
};

}  // namespace vsplit
