#include "features/voted_edges.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "features/mean_edge.h"
#include "mesh/half_edges.h"

namespace vsplit {
namespace {

/// Vertices that edges connect, with the length of the edges and how many there are.
class Chains {
public:
    Chains(const TriangleMesh& mesh, const std::vector<SharpEdge>& edges)
        : leader_(mesh.positions.size()), length_(mesh.positions.size(), 0), loops_(mesh.positions.size(), false) {
        std::iota(leader_.begin(), leader_.end(), 0U);
        for (const SharpEdge& edge : edges) join(edge.a, edge.b);
        for (const SharpEdge& edge : edges) {
            length_[leader(edge.a)] += (mesh.positions[edge.a] - mesh.positions[edge.b]).norm();
        }
    }

    [[nodiscard]] double length(std::uint32_t vertex) { return length_[leader(vertex)]; }
    [[nodiscard]] bool loops(std::uint32_t vertex) { return loops_[leader(vertex)]; }

private:
    std::uint32_t leader(std::uint32_t v) {
        while (leader_[v] != v) v = leader_[v] = leader_[leader_[v]];
        return v;
    }

    void join(std::uint32_t a, std::uint32_t b) {
        a = leader(a);
        b = leader(b);
        const std::uint32_t first = std::min(a, b);
        loops_[first] = a == b || loops_[a] || loops_[b];
        leader_[std::max(a, b)] = first;
    }

    std::vector<std::uint32_t> leader_;
    std::vector<double> length_;
    std::vector<bool> loops_;
};

}  // namespace

std::vector<SharpEdge> voted_edges(const TriangleMesh& mesh, const FaceNormals& normals, double angle, double weight) {
    NormalVotingOptions options;
    options.angle = angle;
    const VotedNormals voted = vote_normals(mesh, normals, options);
    const double threshold = std::cos(angle * std::numbers::pi / 180);
    const auto flat = [&](std::uint32_t v) { return voted.vertices[v] == VertexKind::kSurface; };
    const std::vector<HalfEdge> twins = half_edge_twins(mesh);
    std::vector<SharpEdge> edges;
    for (HalfEdge h = 0; h < twins.size(); ++h) {
        const std::uint32_t a = origin(mesh, h);
        const std::uint32_t b = origin(mesh, next(h));
        if (twins[h] == kNone || twins[h] < h || flat(a) || flat(b)) continue;
        const double cosine = voted.normals[face_of(h)].dot(voted.normals[face_of(twins[h])]);
        if (cosine < threshold) edges.push_back({a, b, weight * (1 - cosine)});
    }
    Chains chains(mesh, edges);
    const double shortest = 2 * options.radius * mean_edge(mesh);
    std::erase_if(edges, [&](const SharpEdge& e) { return chains.length(e.a) < shortest && !chains.loops(e.a); });
    return edges;
}

}  // namespace vsplit
