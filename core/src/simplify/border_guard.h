#pragma once

#include <cstdint>
#include <vector>

#include "simplify/border.h"
#include "simplify/fan.h"
#include "simplify/half_edge_mesh.h"
#include "spatial/surface_index.h"

namespace vsplit {

/// Keeps open boundaries within a distance of the source's, and those within it of them, as DeviationGuard keeps surfaces: by
/// the surface alone a boundary might leave a notch or a slit that is narrower than twice the limit.
///
/// Points of the source, the dense mesh's vertices on boundaries, are kept at the edge of the boundary that is near; new edges
/// are tried at their ends, quarters and middle.
class BorderGuard {
public:
    /// The vertices that a step makes one: the one that stays, and the one that goes or kNone for a move.
    struct Ends {
        std::uint32_t kept = kNone;
        std::uint32_t removed = kNone;
    };

    /// \pre `mesh` is the dense mesh, whose boundaries are the source's. O(faces).
    BorderGuard(const HalfEdgeMesh& mesh, const Border& border, double limit);

    /// Whether the boundary may run by `at` between the ends of the open ring. O(points there).
    [[nodiscard]] bool admits(const Fan& fan, const Vec3& at, const Ends& ends);

    /// Does what was admitted last. O(as that).
    void commit();

private:
    struct Place {
        std::uint32_t point = 0;
        std::uint32_t owner = 0;
    };
    [[nodiscard]] bool reaches_source(const Vec3& from, const Vec3& to) const;
    [[nodiscard]] bool collect(std::uint32_t owner);

    double limit_ = 0;
    std::vector<Vec3> points_;
    std::vector<std::uint32_t> next_;   // of a point: the next one at its edge, or kNone
    std::vector<std::uint32_t> first_;  // of a vertex: a point at the boundary edge that leaves it, or kNone
    CreaseIndex source_;
    // Admitted last:
    Ends ends_;
    std::uint32_t last_ = kNone;
    SegmentShape before_{};  // last of the ring to the vertex
    SegmentShape after_{};   // the vertex to the first of the ring
    std::vector<Place> places_;
};

}  // namespace vsplit
