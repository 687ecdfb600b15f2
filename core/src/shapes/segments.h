#pragma once

#include <cstdint>
#include <vector>

#include "mesh/half_edges.h"
#include "vsplit/features/face_normals.h"

namespace vsplit {

/// A mesh cut along its creases: pieces of surface with their borders.
struct Segments {
    /// Half-edges of a segment on its border, in the order in which they follow one another.
    using Loop = std::vector<HalfEdge>;
    struct Segment {
        std::vector<std::uint32_t> faces;  ///< ascending
        std::vector<Loop> loops;           ///< in order of their first half-edge
    };

    std::vector<std::uint32_t> of_face;
    std::vector<Segment> all;  ///< in order of their first face
    std::vector<HalfEdge> twin;

    /// The segment on the other side of a loop, kNone where there are several.
    [[nodiscard]] std::uint32_t across(const Loop& loop) const;
};

/// Edges that bend by more than `angle` degrees part segments; one with the same segment on both sides parts nothing.
/// \pre `mesh` is a closed 2-manifold. O(faces log faces).
[[nodiscard]] Segments find_segments(const TriangleMesh& mesh, const FaceNormals& normals, double angle);

}  // namespace vsplit
