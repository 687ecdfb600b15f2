#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "mesh/disjoint_sets.h"
#include "repair/steps.h"

namespace vsplit {
namespace {

using Entries = std::span<const EdgeIndex::Entry>;

/// A face at an edge, by its angle around it.
struct Leaf {
    double angle = 0;
    HalfEdge half_edge = 0;
    bool along = false;  ///< runs from the edge's first vertex to its second
};

std::vector<Leaf> leaves_around(const TriangleMesh& mesh, Entries entries) {
    const Vec3& from = mesh.positions[entries.front().a];
    const Vec3 axis = (mesh.positions[entries.front().b] - from).normalized();
    const Vec3 x = axis.unitOrthogonal();
    const Vec3 y = axis.cross(x);
    std::vector<Leaf> leaves;
    for (const EdgeIndex::Entry& entry : entries) {
        const Vec3 to_apex = mesh.positions[origin(mesh, prev(entry.half_edge))] - from;
        leaves.push_back(
            {std::atan2(y.dot(to_apex), x.dot(to_apex)), entry.half_edge, origin(mesh, entry.half_edge) == entries.front().a});
    }
    std::stable_sort(leaves.begin(), leaves.end(), [](const Leaf& l, const Leaf& r) { return l.angle < r.angle; });
    return leaves;
}

void pair_up(std::vector<HalfEdge>& mates, HalfEdge h, HalfEdge g) {
    mates[h] = g;
    mates[g] = h;
}

/// Pairs faces that have the body between them: going round counter-clockwise, the inside begins at a face that runs against the
/// edge and ends at one that runs along it. Matched like brackets, around the circle.
void pair_around(const TriangleMesh& mesh, Entries entries, std::vector<HalfEdge>& mates) {
    std::vector<Leaf> open;  // faces against the edge that still wait for one along it
    const std::vector<Leaf> leaves = leaves_around(mesh, entries);
    for (int turn = 0; turn < 2; ++turn) {
        for (const Leaf& leaf : leaves) {
            if (mates[leaf.half_edge] != kNone) continue;
            if (!leaf.along && turn == 0) open.push_back(leaf);
            if (!leaf.along || open.empty()) continue;
            pair_up(mates, open.back().half_edge, leaf.half_edge);
            open.pop_back();
        }
    }
}

/// mates[h]: the half-edge that h stays joined to; kNone where there is none, or where h is to become a border.
std::vector<HalfEdge> choose_mates(Draft& draft) {
    const TriangleMesh& mesh = draft.mesh;
    std::vector<HalfEdge> mates(mesh.faces.size() * 3, kNone);
    EdgeIndex(mesh).for_each_edge([&](const EdgeIndex::Entry* first, const EdgeIndex::Entry* last) {
        if (last - first == 1) return;
        const bool agree = origin(mesh, first[0].half_edge) != origin(mesh, first[1].half_edge);
        if (last - first == 2 && agree) return pair_up(mates, first[0].half_edge, first[1].half_edge);
        if (last - first > 2) pair_around(mesh, {first, last}, mates);
        draft.changes.add(Finding::Kind::kSplitEdge, (draft.at(first->a) + draft.at(first->b)) / 2,
                          draft.parent[face_of(first->half_edge)]);
    });
    return mates;
}

/// Gives every fan of faces a vertex of its own; the first fan keeps the one there was.
void split_fans(Draft& draft, const std::vector<HalfEdge>& mates) {
    TriangleMesh& mesh = draft.mesh;
    DisjointSets fans(mates.size());
    for (HalfEdge h = 0; h < mates.size(); ++h) {
        if (mates[h] == kNone || mates[h] < h) continue;
        fans.join(h, next(mates[h]));
        fans.join(next(h), mates[h]);
    }
    std::vector<std::uint32_t> vertex_of(mates.size(), kNone);  // of a fan, by its root
    std::vector<bool> taken(mesh.positions.size(), false);
    for (HalfEdge h = 0; h < mates.size(); ++h) {
        const std::uint32_t v = origin(mesh, h);
        std::uint32_t& mine = vertex_of[fans.find(h)];
        if (mine == kNone && !taken[v]) {
            taken[v] = true;
            mine = v;
        } else if (mine == kNone) {
            mine = mesh.vertex_count();
            mesh.positions.push_back(Vec3(mesh.positions[v]));
            draft.changes.add(Finding::Kind::kSplitVertex, mesh.positions[v], draft.parent[face_of(h)]);
        }
        mesh.faces[h / 3][h % 3] = mine;
    }
}

/// Two edges that still have the same ends, because these are whole, are told apart by a vertex in the middle of one.
void split_double_edges(Draft& draft, const std::vector<HalfEdge>& mates) {
    TriangleMesh& mesh = draft.mesh;
    std::vector<SideVertex> middles;
    EdgeIndex(mesh).for_each_edge([&](const EdgeIndex::Entry* first, const EdgeIndex::Entry* last) {
        bool is_first = true;
        for (const auto* entry = first; entry != last; ++entry) {
            const HalfEdge h = entry->half_edge;
            if (mates[h] != kNone && mates[h] < h) continue;  // seen with its mate
            if (std::exchange(is_first, false)) continue;
            middles.push_back({h, 0.5, mesh.vertex_count()});
            if (mates[h] != kNone) middles.push_back({mates[h], 0.5, mesh.vertex_count()});
            mesh.positions.push_back((draft.at(entry->a) + draft.at(entry->b)) / 2);
        }
    });
    insert_on_sides(draft, std::move(middles));
}

}  // namespace

void split_non_manifold(Draft& draft) {
    const std::vector<HalfEdge> mates = choose_mates(draft);
    split_fans(draft, mates);
    split_double_edges(draft, mates);
}

}  // namespace vsplit
