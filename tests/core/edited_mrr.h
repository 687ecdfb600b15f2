#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "simplify/collapse_log.h"
#include "simplify/half_edge_mesh.h"
#include "tests/core/random.h"
#include "vsplit/mrr/multires_mesh.h"

/// Representations with records of all three kinds, made without a method: whatever is allowed is done at random.
namespace vsplit::test {

/// A mesh that is collapsed, flipped and moved at random, and the log of it.
class RandomEditor {
public:
    /// The first `ghosts` vertices of `mesh` are ghosts. \pre `mesh` is closed.
    RandomEditor(const TriangleMesh& mesh, std::uint32_t ghosts, std::uint64_t seed);

    /// One collapse that keeps the surface a manifold and its boundaries apart. False when none was found.
    [[nodiscard]] bool collapse();
    /// Tries `flips` flips and `moves` moves, some of which come back to where they began.
    void edit(int flips, int moves);

    /// What is left, ghosts included, in the order it had.
    [[nodiscard]] TriangleMesh complex() const;
    [[nodiscard]] MultiresMesh build() { return log_.build(mesh_); }

    /// Whether the edge of h may be turned: no ghost near by, no end of valence 3, no such edge yet.
    [[nodiscard]] bool may_flip(HalfEdge h) const;

    [[nodiscard]] HalfEdgeMesh& mesh() { return mesh_; }

private:
    [[nodiscard]] bool may_collapse(const EdgeStar& star) const;
    [[nodiscard]] bool is_ghost(std::uint32_t v) const { return v < ghosts_; }
    [[nodiscard]] std::optional<std::uint32_t> ghost_beside(std::uint32_t v) const;
    [[nodiscard]] bool joined(std::uint32_t u, std::uint32_t v) const;
    [[nodiscard]] HalfEdge any_half_edge();
    void move(std::uint32_t v, const Vec3& to);

    std::uint32_t ghosts_;
    Random random_;
    HalfEdgeMesh mesh_;
    CollapseLog log_;
};

struct EditedMrr {
    MultiresMesh mrr;
    std::vector<TriangleMesh> complexes;  ///< the mesh each level was, finest first, as the editor numbers it; when asked for
};

/// Collapses `mesh` at most `collapses` times, with a few edits after each. Open meshes are capped.
[[nodiscard]] EditedMrr edited_mrr(const TriangleMesh& mesh, int collapses, std::uint64_t seed, bool keep_complexes = false);

/// The faces of a mesh as points, in an order that does not depend on how vertices, faces and corners are numbered.
[[nodiscard]] std::vector<std::array<std::array<double, 3>, 3>> unnumbered(const TriangleMesh& mesh);

}  // namespace vsplit::test
