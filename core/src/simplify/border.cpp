#include "simplify/border.h"

namespace vsplit {

Border::Border(const TriangleMesh& mesh, std::uint32_t ghosts, const std::vector<std::uint32_t>& corners, bool frozen)
    : ghosts_(ghosts) {
    if (ghosts == 0) return;
    holds_.assign(mesh.positions.size(), Hold::kFree);
    ghost_beside_.assign(mesh.positions.size(), kNone);
    for (const Triangle& face : mesh.faces) {
        const std::uint32_t ghost = *std::min_element(face.begin(), face.end());
        if (ghost >= ghosts) continue;
        for (const std::uint32_t v : face) {
            holds_[v] = frozen ? Hold::kFrozen : Hold::kAlong;
            ghost_beside_[v] = ghost;
        }
    }
    for (const std::uint32_t corner : corners) holds_[corner] = std::max(holds_[corner], Hold::kCorner);
    std::fill_n(holds_.begin(), ghosts, Hold::kGhost);
}

}  // namespace vsplit
