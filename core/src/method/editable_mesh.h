#pragma once

#include <cstdint>
#include <vector>

#include "mesh/half_edges.h"
#include "vsplit/features/sharp_edges.h"

namespace vsplit {

/// A closed mesh whose edges are split and turned, with marks on its creases. Half-edges are numbered by faces as everywhere;
/// new vertices and faces get the next numbers.
class EditableMesh {
public:
    /// \pre `mesh` is a closed 2-manifold that has the edges of `creases`.
    EditableMesh(const TriangleMesh& mesh, const std::vector<SharpEdge>& creases);

    [[nodiscard]] const TriangleMesh& mesh() const { return mesh_; }
    [[nodiscard]] HalfEdge twin(HalfEdge h) const { return twin_[h]; }
    [[nodiscard]] std::uint32_t valence(std::uint32_t v) const { return valence_[v]; }
    [[nodiscard]] std::uint32_t origin(HalfEdge h) const { return vsplit::origin(mesh_, h); }
    [[nodiscard]] std::uint32_t target(HalfEdge h) const { return origin(next(h)); }
    [[nodiscard]] const Vec3& position(std::uint32_t v) const { return mesh_.positions[v]; }
    [[nodiscard]] bool is_crease(HalfEdge h) const { return crease_[h] >= 0; }
    /// The half-edges that leave v, counter-clockwise.
    [[nodiscard]] std::vector<HalfEdge> spokes(std::uint32_t v) const;
    [[nodiscard]] bool has_edge(std::uint32_t from, std::uint32_t to) const;

    /// Puts a vertex at `place` on the edge of h, which then runs from its origin to that vertex. The two faces are cut, the new
    /// ones of either side lie at the target that h had. The new vertex. O(1).
    std::uint32_t split(HalfEdge h, const Vec3& place);

    /// See turn_counter_clockwise. \pre both ends have valence 4 or more, the vertices opposite no edge, and it is no crease.
    /// O(1).
    void turn(HalfEdge h);

    /// In order of their first half-edge.
    [[nodiscard]] std::vector<SharpEdge> creases() const;

private:
    /// Half-edge `fresh` takes the place of `old`: its twin and its mark.
    void take_over(HalfEdge fresh, HalfEdge old);
    void pair(HalfEdge h, HalfEdge g, double crease);

    TriangleMesh mesh_;
    std::vector<HalfEdge> twin_;
    std::vector<double> crease_;  // of a half-edge: the weight of its crease, or kNoCrease
    std::vector<HalfEdge> outgoing_;
    std::vector<std::uint32_t> valence_;
};

/// Creases of a mesh as those of its CappedMesh, and back.
[[nodiscard]] std::vector<SharpEdge> with_ghosts(std::vector<SharpEdge> creases, std::uint32_t ghosts);
[[nodiscard]] std::vector<SharpEdge> without_ghosts(std::vector<SharpEdge> creases, std::uint32_t ghosts);

}  // namespace vsplit
