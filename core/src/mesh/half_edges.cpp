#include "mesh/half_edges.h"

#include <tbb/parallel_sort.h>

#include <tuple>

namespace vsplit {

EdgeIndex::EdgeIndex(const TriangleMesh& mesh) {
    entries_.resize(mesh.faces.size() * 3);
    for (std::size_t h = 0; h < entries_.size(); ++h) {
        const auto half_edge = static_cast<HalfEdge>(h);
        const std::uint64_t from = origin(mesh, half_edge);
        const std::uint64_t to = origin(mesh, next(half_edge));
        entries_[h] = {from < to ? from << 32U | to : to << 32U | from, half_edge};
    }
    tbb::parallel_sort(entries_.begin(), entries_.end(), [](const Entry& left, const Entry& right) {
        return std::tie(left.key, left.half_edge) < std::tie(right.key, right.half_edge);
    });
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

}  // namespace vsplit
