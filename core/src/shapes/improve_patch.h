#pragma once

#include <cstdint>
#include <vector>

#include "vsplit/base/expected.h"
#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// A disk with its border: the vertices 0 to `border` - 1 in order; others are inside.
struct Patch {
    TriangleMesh mesh;
    std::uint32_t border = 0;
};

/// The patch with well shaped faces no larger than `size` but where an edge of its border is, its border unchanged. As it was
/// where it cannot be improved. \pre all of its vertices are on the border; no two are at one place.
[[nodiscard]] Patch improve_patch(const Patch& patch, double size);

}  // namespace vsplit
