#include "features/voted_edges.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "features/mean_edge.h"
#include "mesh/disjoint_sets.h"
#include "mesh/half_edges.h"

namespace vsplit {
namespace {

/// Vertices that edges connect, with the length of the edges and how many there are.
class Chains {
public:
    Chains(const TriangleMesh& mesh, const std::vector<SharpEdge>& edges)
        : joined_(mesh.positions.size()), length_(mesh.positions.size(), 0), loops_(mesh.positions.size(), false) {
        for (const SharpEdge& edge : edges) join(edge.a, edge.b);
        for (const SharpEdge& edge : edges) {
            length_[joined_.find(edge.a)] += (mesh.positions[edge.a] - mesh.positions[edge.b]).norm();
        }
    }

    [[nodiscard]] double length(std::uint32_t vertex) { return length_[joined_.find(vertex)]; }
    [[nodiscard]] bool loops(std::uint32_t vertex) { return loops_[joined_.find(vertex)]; }

private:
    void join(std::uint32_t a, std::uint32_t b) {
        const std::uint32_t of_a = joined_.find(a), of_b = joined_.find(b);
        const bool loops = of_a == of_b || loops_[of_a] || loops_[of_b];
        joined_.join(a, b);
        loops_[joined_.find(a)] = loops;
    }

    DisjointSets joined_;
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
