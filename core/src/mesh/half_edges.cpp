#include "mesh/half_edges.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <numeric>
#include <tuple>

#include "base/huge_pages.h"

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

/// Calls visit(h, a, b) for the half-edges of edge (a, b), a < b; those of the same a in order and in one thread. What takes the
/// time is what is visited at a: each thread goes through all faces and leaves to others the vertices that are theirs.
template <class Visit>
void for_each_half_edge(const std::vector<Triangle>& faces, std::size_t vertices, Visit visit) {
    constexpr std::size_t kMostParts = 8, kFacesWorthAPart = 50'000;
    const auto threads = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
    const std::size_t parts = std::clamp<std::size_t>(faces.size() / kFacesWorthAPart, 1, std::min(kMostParts, threads));
    tbb::parallel_for(std::size_t{0}, parts, [&](std::size_t part) {
        const std::size_t begin = vertices * part / parts, count = vertices * (part + 1) / parts - begin;
        for (std::size_t f = 0; f < faces.size(); ++f) {
            const Triangle& t = faces[f];
            for (std::size_t corner = 0; corner < 3; ++corner) {
                const auto [a, b] = std::minmax({t[corner], t[corner == 2 ? 0 : corner + 1]});
                if (a - begin < count) visit(static_cast<HalfEdge>(3 * f + corner), a, b);
            }
        }
    });
}

}  // namespace

EdgeIndex::EdgeIndex(const std::vector<Triangle>& faces, std::size_t vertices) {
    // A counting sort by the smaller vertex, which leaves half-edges in order; then each vertex's few edges by the larger one.
    auto first = large_vector<std::uint32_t>(vertices + 1);
    entries_ = large_vector<Entry>(faces.size() * 3);
    for_each_half_edge(faces, vertices, [&](HalfEdge /*h*/, std::uint32_t a, std::uint32_t /*b*/) { ++first[a + 1]; });
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<std::uint32_t> slot(first.begin(), first.end() - 1);
    for_each_half_edge(faces, vertices, [&](HalfEdge h, std::uint32_t a, std::uint32_t b) { entries_[slot[a]++] = {a, b, h}; });
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, vertices, 4096), [&](const tbb::blocked_range<std::size_t>& range) {
        for (std::size_t v = range.begin(); v < range.end(); ++v)
            sort_edges(entries_.data() + first[v], entries_.data() + first[v + 1]);
    });
}

std::vector<HalfEdge> half_edge_twins(const TriangleMesh& mesh) { return half_edge_twins(mesh, EdgeIndex(mesh)); }

std::vector<HalfEdge> half_edge_twins(const TriangleMesh& mesh, const EdgeIndex& edges) {
    auto twins = large_vector<HalfEdge>(mesh.faces.size() * 3, kNone);
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
    auto valence = large_vector<std::uint32_t>(mesh.positions.size());
    edges.for_each_edge([&](const EdgeIndex::Entry* first, const EdgeIndex::Entry* /*last*/) {
        ++valence[first->a];
        ++valence[first->b];
    });
    return valence;
}

std::vector<std::uint32_t> valences(const TriangleMesh& mesh) { return valences(mesh, EdgeIndex(mesh)); }

}  // namespace vsplit
