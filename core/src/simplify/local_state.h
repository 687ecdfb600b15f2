#pragma once

#include <vector>

#include "simplify/border.h"
#include "simplify/simplify.h"
#include "simplify/vertex_sizes.h"

namespace vsplit {

/// Shape of a live face and where it looks; the normal of a sliver may be borrowed. Half a cache line: two are never straddled.
struct alignas(32) FaceState {
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();  // only to be compared with another: single precision is plenty
    double stretch = 0;
    double size = 0;  // against what is wanted, where sizes are given
};

/// Everything the simplifier knows of the mesh beside its connectivity.
struct LocalState {
    std::vector<FaceState> faces;
    std::vector<Quadric> quadrics;
    VertexSizes sizes;
    Border border;
};

/// The state before the first collapse. O(faces).
[[nodiscard]] LocalState initial_state(const SimplifyInput& input);
/// The same, leaving neither mesh nor what goes over into the state behind: at this moment memory is at its fullest.
[[nodiscard]] LocalState take_initial_state(SimplifyInput& input);

}  // namespace vsplit
