#include "quality/kept_creases.h"

#include <algorithm>
#include <utility>

#include "mesh/half_edges.h"
#include "quality/deviation_of_index.h"
#include "vsplit/features/face_normals.h"

namespace vsplit {
namespace {

using Edges = std::vector<EdgeEnds>;

constexpr double kAlong = 0.03;  // of its length, an edge is off a crease that no bend tells

EdgeEnds ends_of(const SharpEdge& edge) { return {std::min(edge.a, edge.b), std::max(edge.a, edge.b)}; }

Edges ends_of(const std::vector<SharpEdge>& edges) {
    Edges ends;
    for (const SharpEdge& edge : edges) ends.push_back(ends_of(edge));
    return ends;
}

/// Those that bend by more than `angle`, and boundary edges.
Edges bends_of(const TriangleMesh& mesh, double angle) {
    return ends_of(find_sharp_edges(mesh, face_normals(mesh), {.angle = angle, .weight = 1}));
}

Edges edges_of(const TriangleMesh& mesh) {
    Edges edges;
    EdgeIndex(mesh).for_each_edge([&](const auto* first, const auto*) { edges.push_back({first->a, first->b}); });
    return edges;
}

/// The creases that are among the `bends`, and the others.
std::pair<Edges, Edges> split_by_bend(const std::vector<SharpEdge>& creases, Edges bends) {
    std::sort(bends.begin(), bends.end());
    std::pair<Edges, Edges> split;
    for (const SharpEdge& crease : creases) {
        const bool bent = std::binary_search(bends.begin(), bends.end(), ends_of(crease));
        (bent ? split.first : split.second).push_back(ends_of(crease));
    }
    return split;
}

}  // namespace

Expected<std::optional<DirectedDeviation>> measure_kept_creases(const TriangleMesh& result, const TriangleMesh& source,
                                                                const std::vector<SharpEdge>& creases, double angle,
                                                                const DeviationOptions& accuracy,
                                                                const ExecutionContext& context) {
    std::optional<DirectedDeviation> furthest;
    const auto [bent, flat] = split_by_bend(creases, bends_of(source, angle));
    const double diagonal = bounding_box(source).diagonal();
    const auto measure = [&](const Edges& from, const Edges& to) -> Status {
        const Expected<SearchLimits> limits = search_limits(accuracy, diagonal, std::uint64_t{from.size()} + to.size());
        if (!limits) return limits.error();
        const Expected<DirectedDeviation> distance = directed_deviation<SegmentShape>(
            {source.positions, from}, crease_index(result.positions, to), *limits, context, [](double) {});
        if (!distance) return distance.error();
        if (!furthest || distance->upper > furthest->upper) furthest = *distance;
        return Done{};
    };
    if (!bent.empty()) {
        if (Status done = measure(bent, bends_of(result, angle)); !done) return done.error();
    }
    if (!flat.empty()) {
        if (Status done = measure(flat, edges_of(result)); !done) return done.error();
    }
    return furthest;
}

std::vector<SharpEdge> creases_kept(const TriangleMesh& result, const TriangleMesh& source, const std::vector<SharpEdge>& creases,
                                    double angle, double distance) {
    const auto [bent, flat] = split_by_bend(creases, bends_of(source, angle));
    const CreaseIndex bends = crease_index(source.positions, bent);
    const CreaseIndex lines = crease_index(source.positions, flat);
    const auto along = [&](const CreaseIndex& index, const EdgeEnds& edge, double reach) {
        const Vec3 &a = result.positions[edge[0]], &b = result.positions[edge[1]];
        return index.within(a, reach) && index.within(b, reach) && index.within((a + b) / 2, reach);
    };
    Edges bends_here = bends_of(result, angle);
    std::sort(bends_here.begin(), bends_here.end());
    std::vector<SharpEdge> kept;
    EdgeIndex(result).for_each_edge([&](const auto* first, const auto* last) {
        const EdgeEnds edge{first->a, first->b};
        const double length = (result.positions[edge[1]] - result.positions[edge[0]]).norm();
        const bool bend = std::binary_search(bends_here.begin(), bends_here.end(), edge) && along(bends, edge, distance);
        if (last - first == 1 || bend || along(lines, edge, kAlong * length)) kept.push_back({edge[0], edge[1], 1});
    });
    return kept;
}

}  // namespace vsplit
