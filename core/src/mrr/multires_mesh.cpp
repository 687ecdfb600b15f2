#include "vsplit/mrr/multires_mesh.h"

#include <algorithm>

#include "mesh/cap_boundaries.h"

namespace vsplit {

std::uint32_t MultiresMesh::faces_at(std::size_t level) const {
    const auto singles = std::lower_bound(border_splits.begin(), border_splits.end(), level) - border_splits.begin();
    return faces_min() + 2 * static_cast<std::uint32_t>(level) - static_cast<std::uint32_t>(singles);
}

std::size_t MultiresMesh::level_for(std::uint32_t faces) const {
    std::size_t low = 0;  // has at most `faces` faces, or is the base
    std::size_t high = levels() + 1;
    while (high - low > 1) {
        const std::size_t middle = low + (high - low) / 2;
        (faces_at(middle) <= faces ? low : high) = middle;
    }
    return low;
}

std::size_t MultiresMesh::record_of_level(std::size_t level) const {
    return level == 0 ? 0 : records.record_of_split(level - 1) + 1;
}

std::uint32_t count_ghost_faces(const TriangleMesh& complex, std::uint32_t ghosts) {
    if (ghosts == 0) return 0;
    return static_cast<std::uint32_t>(std::count_if(complex.faces.begin(), complex.faces.end(),
                                                    [ghosts](const Triangle& face) { return touches_ghost(face, ghosts); }));
}

}  // namespace vsplit
