#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "mesh/half_edges.h"
#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// How a vertex of a capped mesh is held by an open boundary, the stronger the larger.
enum class Hold : std::uint8_t {
    kFree,    ///< inside
    kAlong,   ///< stays on the boundary
    kCorner,  ///< stays where it is; two of them may join where they are within the tolerance of each other
    kFrozen,  ///< stays where it is, and so do its edges along the boundary
    kGhost,   ///< closes a boundary; seen by nobody
};

/// The open boundaries of a mesh that ghosts close (see CappedMesh): which vertex lies on which, and how it is held. Without
/// ghosts there is nothing to hold and nothing is kept.
class Border {
public:
    Border() = default;
    /// \pre the first `ghosts` vertices of `mesh` are ghosts; `corners` are others, on a boundary. O(faces).
    Border(const TriangleMesh& mesh, std::uint32_t ghosts, const std::vector<std::uint32_t>& corners, bool frozen);

    [[nodiscard]] bool empty() const { return ghosts_ == 0; }
    [[nodiscard]] std::uint32_t ghosts() const { return ghosts_; }
    [[nodiscard]] bool is_ghost(std::uint32_t v) const { return v < ghosts_; }
    [[nodiscard]] Hold hold(std::uint32_t v) const { return empty() ? Hold::kFree : holds_[v]; }
    /// The ghost of the boundary that v lies on, or kNone inside.
    [[nodiscard]] std::uint32_t ghost_beside(std::uint32_t v) const { return empty() ? kNone : ghost_beside_[v]; }

    /// Whether a collapse may join two vertices: never ghosts, nor two boundaries, nor what is frozen.
    [[nodiscard]] bool may_join(std::uint32_t i, std::uint32_t j) const {
        if (empty()) return true;
        const auto [less, more] = std::minmax(holds_[i], holds_[j]);
        if (more == Hold::kGhost || less == Hold::kFrozen) return false;
        return less == Hold::kFree || ghost_beside_[i] == ghost_beside_[j];
    }

    /// A collapse made one vertex of both. \pre may_join.
    void join(std::uint32_t kept, std::uint32_t removed) {
        if (empty()) return;
        holds_[kept] = std::max(holds_[kept], holds_[removed]);
        if (ghost_beside_[kept] == kNone) ghost_beside_[kept] = ghost_beside_[removed];
    }

private:
    std::uint32_t ghosts_ = 0;
    std::vector<Hold> holds_;
    std::vector<std::uint32_t> ghost_beside_;
};

}  // namespace vsplit
