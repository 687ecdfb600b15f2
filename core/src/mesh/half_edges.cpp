#include "mesh/half_edges.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <numeric>
#include <tuple>

namespace vsplit {
namespace {

/// By b. \pre all have the same a, in order of half-edges. Nearly all vertices have a few edges only, for which this is quickest.
void sort_edges(EdgeIndex::Entry* first, EdgeIndex::Entry* last) {
    constexpr std::ptrdiff_t kFew = 32;
    if (last - first > kFew) {
        std::sort(first, last, [](const EdgeIndex::Entry& left, const EdgeIndex::Entry& right) {
            return std::tie(left.b, left.half_edge) < std::tie(right.b, right.half_edge);
        });
        return;
    }
    for (EdgeIndex::Entry* entry = first; entry < last; ++entry) {
        const EdgeIndex::Entry moved = *entry;
        EdgeIndex::Entry* to = entry;
        for (; to > first && (to - 1)->b > moved.b; --to) *to = *(to - 1);
        *to = moved;
    }
}

}  // namespace

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
        entries_[slot[a]++] = {a, b, h};
    }
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, vertices, 4096), [&](const tbb::blocked_range<std::size_t>& range) {
        for (std::size_t v = range.begin(); v < range.end(); ++v)
            sort_edges(entries_.data() + first[v], entries_.data() + first[v + 1]);
    });
}

std::vector<HalfEdge> half_edge_twins(const TriangleMesh& mesh) { return half_edge_twins(mesh, EdgeIndex(mesh)); }

std::vector<HalfEdge> half_edge_twins(const TriangleMesh& mesh, const EdgeIndex& edges) {
    std::vector<HalfEdge> twins(mesh.faces.size() * 3, kNone);
    edges.for_each_edge([&](const EdgeIndex::Entry* first, const EdgeIndex::Entry* last) {
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
        ++valence[first->a];
        ++valence[first->b];
    });
    return valence;
}

std::vector<std::uint32_t> valences(const TriangleMesh& mesh) { return valences(mesh, EdgeIndex(mesh)); }

}  // namespace vsplit
