#include "mesh/half_edges.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace vsplit {

EdgeIndex::EdgeIndex(const std::vector<Triangle>& faces, std::size_t vertices) {
    // A counting sort by the smaller vertex, which leaves half-edges in order; then each vertex's few edges by the larger one.
    std::vector<std::uint32_t> first(vertices + 1, 0);
    const auto half_edges = static_cast<HalfEdge>(faces.size() * 3);
    const auto ends = [&](HalfEdge h) { return std::minmax({origin(faces, h), origin(faces, next(h))}); };
    for (HalfEdge h = 0; h < half_edges; ++h) ++first[ends(h).first + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    entries_.resize(half_edges);
    std::vector<std::uint32_t> slot(first.begin(), first.end() - 1);
    for (HalfEdge h = 0; h < half_edges; ++h) {
        const auto [a, b] = ends(h);
        entries_[slot[a]++] = {std::uint64_t{a} << 32U | b, h};
    }
    for (std::size_t v = 0; v + 1 < first.size(); ++v) {
        std::sort(entries_.begin() + first[v], entries_.begin() + first[v + 1], [](const Entry& left, const Entry& right) {
            return std::tie(left.key, left.half_edge) < std::tie(right.key, right.half_edge);
        });
    }
}

std::vector<HalfEdge> half_edge_twins(const TriangleMesh& mesh) {
    std::vector<HalfEdge> twins(mesh.faces.size() * 3, kNone);
    EdgeIndex(mesh).for_each_edge([&](const EdgeIndex::Entry* first, const EdgeIndex::Entry* last) {
        if (last - first != 2) return;
        const HalfEdge h = first[0].half_edge;
        const HalfEdge g = first[1].half_edge;
        if (origin(mesh, h) == origin(mesh, g)) return;
        twins[h] = g;
        twins[g] = h;
    });
    return twins;
}

std::vector<std::uint32_t> valences(const TriangleMesh& mesh, const EdgeIndex& edges) {
    std::vector<std::uint32_t> valence(mesh.positions.size(), 0);
    edges.for_each_edge([&](const EdgeIndex::Entry* first, const EdgeIndex::Entry* /*last*/) {
        ++valence[first->a()];
        ++valence[first->b()];
    });
    return valence;
}

std::vector<std::uint32_t> valences(const TriangleMesh& mesh) { return valences(mesh, EdgeIndex(mesh)); }

}  // namespace vsplit
