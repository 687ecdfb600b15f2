#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "mesh/boundary_loops.h"
#include "repair/loop_triangulation.h"
#include "repair/pieces.h"
#include "repair/steps.h"

namespace vsplit {
namespace {

constexpr std::size_t kMostEdges = 500;  // the cubic search takes 0.1 s for so many
constexpr double kOuterShare = 0.5;      // of a piece's box: a border so large is its rim

using Loop = std::vector<HalfEdge>;
using Edges = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

double box_diagonal(const TriangleMesh& mesh, const Loop& loop) {
    BoundingBox box;
    for (const HalfEdge h : loop) {
        box.min = box.min.cwiseMin(mesh.positions[origin(mesh, h)]);
        box.max = box.max.cwiseMax(mesh.positions[origin(mesh, h)]);
    }
    return box.diagonal();
}

/// The edges between vertices of borders, each as (smaller, larger), ascending.
Edges edges_between_borders(const TriangleMesh& mesh, const std::vector<Loop>& loops) {
    std::vector<bool> on_border(mesh.positions.size(), false);
    for (const Loop& loop : loops) {
        for (const HalfEdge h : loop) on_border[origin(mesh, h)] = true;
    }
    Edges edges;
    EdgeIndex(mesh).for_each_edge([&](const EdgeIndex::Entry* first, const EdgeIndex::Entry* /*last*/) {
        if (on_border[first->a] && on_border[first->b]) edges.emplace_back(first->a, first->b);
    });
    std::sort(edges.begin(), edges.end());
    return edges;
}

/// The border's vertices in the direction in which the missing faces run.
std::vector<std::uint32_t> hole_vertices(const TriangleMesh& mesh, const Loop& loop) {
    std::vector<std::uint32_t> vertices(loop.size());
    std::transform(loop.rbegin(), loop.rend(), vertices.begin(), [&mesh](HalfEdge h) { return origin(mesh, h); });
    return vertices;
}

/// A fan around a new vertex in the middle: where every triangulation needs an edge that is there already.
std::vector<Triangle> fan(TriangleMesh& mesh, const std::vector<std::uint32_t>& vertices) {
    Vec3 middle = Vec3::Zero();
    for (const std::uint32_t v : vertices) middle += mesh.positions[v] / static_cast<double>(vertices.size());
    std::vector<Triangle> faces;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        faces.push_back({vertices[i], vertices[(i + 1) % vertices.size()], mesh.vertex_count()});
    }
    mesh.positions.push_back(middle);
    return faces;
}

std::vector<Triangle> fill(TriangleMesh& mesh, const std::vector<std::uint32_t>& vertices, const Edges& edges) {
    std::vector<Vec3> corners;
    for (const std::uint32_t v : vertices) corners.push_back(mesh.positions[v]);
    std::vector<Triangle> faces = triangulate_loop(corners, [&](std::uint32_t i, std::uint32_t j) {
        const auto [a, b] = std::minmax(vertices[i], vertices[j]);
        if (corners[i] == corners[j]) return false;  // copies that were cut apart: both faces on such an edge would have no area
        return !std::binary_search(edges.begin(), edges.end(), std::pair(a, b));
    });
    if (faces.empty()) return fan(mesh, vertices);
    for (Triangle& face : faces) {
        for (std::uint32_t& corner : face) corner = vertices[corner];
    }
    return faces;
}

}  // namespace

void fill_holes(Draft& draft, double size, const ExecutionContext& context) {
    TriangleMesh& mesh = draft.mesh;
    const std::vector<Loop> loops = boundary_loops(mesh);
    if (loops.empty()) return;
    const Pieces pieces = find_pieces(mesh);
    const Edges edges = edges_between_borders(mesh, loops);
    for (const Loop& loop : loops) {
        if (context.cancelled()) return;
        const std::uint32_t beside = face_of(loop.front());
        const double extent = box_diagonal(mesh, loop);
        const bool is_rim = extent > kOuterShare * pieces.box[pieces.of_face[beside]].diagonal();
        if (loop.size() > kMostEdges || extent > size || is_rim) continue;
        const Vec3 place = draft.at(origin(mesh, loop.front()));
        draft.add_faces(fill(mesh, hole_vertices(mesh, loop), edges), beside);
        draft.changes.add(Finding::Kind::kFilledHole, place, draft.parent[beside]);
    }
}

}  // namespace vsplit
