#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// Half-edges (corners) are numbered 3 * face + (0, 1, 2): half-edge h leaves the vertex at corner h along its face.
using HalfEdge = std::uint32_t;

inline constexpr std::uint32_t kNone = 0xFFFFFFFFU;

[[nodiscard]] inline HalfEdge next(HalfEdge h) { return h % 3 == 2 ? h - 2 : h + 1; }
[[nodiscard]] inline HalfEdge prev(HalfEdge h) { return h % 3 == 0 ? h + 2 : h - 1; }
[[nodiscard]] inline std::uint32_t face_of(HalfEdge h) { return h / 3; }

[[nodiscard]] inline std::uint32_t origin(const std::vector<Triangle>& faces, HalfEdge h) { return faces[h / 3][h % 3]; }

/// The vertex at a corner of `mesh`.
[[nodiscard]] inline std::uint32_t origin(const TriangleMesh& mesh, HalfEdge h) { return origin(mesh.faces, h); }

/// Half-edges by undirected edge: those of edge (a, b), a < b, stand together, edges in order of (a, b), half-edges in order of
/// number. Works for any faces, manifold or not. O(faces log(largest valence)).
class EdgeIndex {
public:
    struct Entry {
        std::uint32_t a = 0;  ///< a < b
        std::uint32_t b = 0;
        HalfEdge half_edge = 0;

        [[nodiscard]] bool is_of_same_edge(const Entry& other) const { return a == other.a && b == other.b; }
    };

    explicit EdgeIndex(const TriangleMesh& mesh) : EdgeIndex(mesh.faces, mesh.positions.size()) {}
    EdgeIndex(const std::vector<Triangle>& faces, std::size_t vertices);

    /// Calls visit(first, last), a range of entries, for each undirected edge in order.
    template <class Visit>
    void for_each_edge(Visit visit) const {
        for (std::size_t begin = 0; begin < entries_.size();) {
            std::size_t end = begin + 1;
            while (end < entries_.size() && entries_[end].is_of_same_edge(entries_[begin])) ++end;
            visit(entries_.data() + begin, entries_.data() + end);
            begin = end;
        }
    }

private:
    std::vector<Entry> entries_;
};

/// twin[h]: the half-edge that runs along the same edge the other way, or kNone at a boundary or where the edge is not shared by
/// exactly two faces that run along it in opposite directions. O(faces log faces).
[[nodiscard]] std::vector<HalfEdge> half_edge_twins(const TriangleMesh& mesh);
[[nodiscard]] std::vector<HalfEdge> half_edge_twins(const TriangleMesh& mesh, const EdgeIndex& edges);

/// Edges at each vertex, each counted once: at a boundary one more than faces. O(faces).
[[nodiscard]] std::vector<std::uint32_t> valences(const TriangleMesh& mesh, const EdgeIndex& edges);
[[nodiscard]] std::vector<std::uint32_t> valences(const TriangleMesh& mesh);

}  // namespace vsplit
