#pragma once

#include <cstdint>
#include <vector>

#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// The pieces of a mesh that shared edges connect. A piece is named by its first face.
struct Pieces {
    std::vector<std::uint32_t> of_face;
    std::vector<BoundingBox> box;  ///< by piece
};

/// O(faces log faces).
[[nodiscard]] Pieces find_pieces(const TriangleMesh& mesh);

}  // namespace vsplit
