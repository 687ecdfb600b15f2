#include "features/crease_marks.h"

#include <algorithm>
#include <utility>

namespace vsplit {
namespace {

using Ends = std::pair<std::uint32_t, std::uint32_t>;

}  // namespace

CreaseMarks::CreaseMarks(const TriangleMesh& mesh)
    : mesh_(mesh), twins_(half_edge_twins(mesh)), weights_(twins_.size(), kUnmarked) {}

void CreaseMarks::mark(HalfEdge h, double weight) {
    double& held = weights_[edge_of(h)];
    held = std::max(held, weight);
}

void CreaseMarks::mark(const std::vector<SharpEdge>& edges) {
    if (edges.empty()) return;
    std::vector<std::pair<Ends, double>> wanted;
    wanted.reserve(edges.size());
    for (const SharpEdge& edge : edges) wanted.emplace_back(std::minmax(edge.a, edge.b), edge.weight);
    std::sort(wanted.begin(), wanted.end());
    for (HalfEdge h = 0; h < twins_.size(); ++h) {
        const Ends ends = std::minmax(origin(mesh_, h), origin(mesh_, next(h)));
        const auto first = std::lower_bound(wanted.begin(), wanted.end(), ends,
                                            [](const auto& entry, const Ends& sought) { return entry.first < sought; });
        for (auto at = first; at != wanted.end() && at->first == ends; ++at) mark(h, at->second);
    }
}

std::vector<SharpEdge> CreaseMarks::edges() const {
    std::vector<SharpEdge> all;
    for (HalfEdge h = 0; h < twins_.size(); ++h) {
        if (weights_[h] >= 0) all.push_back({origin(mesh_, h), origin(mesh_, next(h)), weights_[h]});
    }
    return all;
}

}  // namespace vsplit
