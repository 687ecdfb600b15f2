#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// Something about a mesh that a person may want to know, with the places to look at.
struct Finding {
    enum class Kind {
        // What a mesh is like: from `inspect`.
        kBoundaryEdge,       ///< one face only
        kNonManifoldEdge,    ///< more than two faces
        kInconsistentEdge,   ///< two faces that run along it in the same direction
        kNonManifoldVertex,  ///< more than one fan of faces
        kDegenerateFace,     ///< stretch under 1e-9
        kDuplicateFace,      ///< the same three vertices as an earlier face
        kInsideOut,          ///< the mesh is closed and its faces look inwards
        kUnusedVertex,       ///< no face used it; dropped by the weld
        kCollapsedFace,      ///< two corners equal after the weld; dropped
        kUnusedSet,          ///< a named set of the file that no face is in; dropped when it was read
        kSelfIntersection,   ///< two faces without a common vertex that pass through each other; from `repair_mesh`
        // What a repair changed: from `repair_mesh`, which says what each does.
        kMergedVertex,
        kDroppedFace,
        kFlattenedFace,
        kDroppedDuplicate,
        kStitchedVertex,
        kTurnedFace,
        kSplitEdge,
        kSplitVertex,
        kDroppedSpeck,
        kFilledHole,
        kLostFace,      ///< dropped, and no other is in its region, or sets, for it
        kEmptiedGroup,  ///< a set, or a region in no set, that had faces
    };
    static constexpr std::size_t kExamples = 16;

    Kind kind{};
    std::uint32_t count = 0;
    std::string message;                  ///< one sentence: what, how many, where the first is
    std::vector<std::uint32_t> elements;  ///< the first kExamples: face indices, vertex indices, or edges as vertex pairs
    std::vector<Vec3> places{};           ///< points to look at, in order: of what a repair changed all, else one an example
};

/// UPPER_SNAKE_CASE, e.g. "NON_MANIFOLD_EDGE".
[[nodiscard]] std::string_view finding_name(Finding::Kind kind);

}  // namespace vsplit
