#pragma once

#include <span>
#include <vector>

#include "features/crease_marks.h"
#include "spatial/shapes.h"

namespace vsplit {

/// Which points of a source's creases lie at which crease of a mesh: a crease may go only where others near it take them.
class HeldCreases {
public:
    /// `creases` are edges of `source`. Points along them, half of `reach` apart, lie at the nearest marked edge of `mesh` that
    /// is within `reach`. `mesh` need not outlive this. O(creases log creases).
    HeldCreases(const TriangleMesh& mesh, const CreaseMarks& marks, const TriangleMesh& source,
                const std::vector<SharpEdge>& creases, double reach);

    [[nodiscard]] bool is_crease(HalfEdge h) const { return marks_.marked(h); }

    /// Whether `after` are within reach of all points at `before`, creases of the mesh that they replace.
    [[nodiscard]] bool may_become(std::span<const HalfEdge> before, std::span<const SegmentShape> after) const;

private:
    const CreaseMarks& marks_;
    const double reach_square_;
    std::vector<std::uint32_t> first_;  // of an edge, by its number: where its points begin in points_
    std::vector<Vec3> points_;
};

}  // namespace vsplit
