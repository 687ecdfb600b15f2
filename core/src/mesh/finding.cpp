#include "vsplit/mesh/finding.h"

namespace vsplit {

std::string_view finding_name(Finding::Kind kind) {
    switch (kind) {
        case Finding::Kind::kBoundaryEdge:
            return "BOUNDARY_EDGE";
        case Finding::Kind::kNonManifoldEdge:
            return "NON_MANIFOLD_EDGE";
        case Finding::Kind::kInconsistentEdge:
            return "INCONSISTENT_EDGE";
        case Finding::Kind::kNonManifoldVertex:
            return "NON_MANIFOLD_VERTEX";
        case Finding::Kind::kDegenerateFace:
            return "DEGENERATE_FACE";
        case Finding::Kind::kDuplicateFace:
            return "DUPLICATE_FACE";
        case Finding::Kind::kInsideOut:
            return "INSIDE_OUT";
        case Finding::Kind::kUnusedVertex:
            return "UNUSED_VERTEX";
        case Finding::Kind::kCollapsedFace:
            return "COLLAPSED_FACE";
        case Finding::Kind::kUnusedSet:
            return "UNUSED_SET";
        case Finding::Kind::kSelfIntersection:
            return "SELF_INTERSECTION";
        case Finding::Kind::kMergedVertex:
            return "MERGED_VERTEX";
        case Finding::Kind::kDroppedFace:
            return "DROPPED_FACE";
        case Finding::Kind::kFlattenedFace:
            return "FLATTENED_FACE";
        case Finding::Kind::kDroppedDuplicate:
            return "DROPPED_DUPLICATE";
        case Finding::Kind::kStitchedVertex:
            return "STITCHED_VERTEX";
        case Finding::Kind::kTurnedFace:
            return "TURNED_FACE";
        case Finding::Kind::kSplitEdge:
            return "SPLIT_EDGE";
        case Finding::Kind::kSplitVertex:
            return "SPLIT_VERTEX";
        case Finding::Kind::kDroppedSpeck:
            return "DROPPED_SPECK";
        case Finding::Kind::kFilledHole:
            return "FILLED_HOLE";
        case Finding::Kind::kLostFace:
            return "LOST_FACE";
        case Finding::Kind::kEmptiedGroup:
            return "EMPTIED_GROUP";
    }
    return "UNKNOWN";
}

}  // namespace vsplit
