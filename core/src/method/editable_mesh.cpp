#include "method/editable_mesh.h"

#include "mesh/turn_edge.h"

namespace vsplit {
namespace {

constexpr double kNoCrease = -1;

}  // namespace

EditableMesh::EditableMesh(const TriangleMesh& mesh, const std::vector<SharpEdge>& creases)
    : mesh_(mesh),
      twin_(half_edge_twins(mesh)),
      crease_(twin_.size(), kNoCrease),
      outgoing_(mesh.positions.size(), kNone),
      valence_(mesh.positions.size(), 0) {
    for (HalfEdge h = 0; h < twin_.size(); ++h) {
        outgoing_[origin(h)] = h;
        ++valence_[origin(h)];
    }
    for (const SharpEdge& crease : creases) {
        for (const HalfEdge h : spokes(crease.a)) {
            if (target(h) == crease.b) crease_[h] = crease_[twin(h)] = crease.weight;
        }
    }
}

std::vector<HalfEdge> EditableMesh::spokes(std::uint32_t v) const {
    std::vector<HalfEdge> all;
    HalfEdge h = outgoing_[v];
    do {
        all.push_back(h);
        h = twin_[prev(h)];
    } while (h != outgoing_[v]);
    return all;
}

bool EditableMesh::has_edge(std::uint32_t from, std::uint32_t to) const {
    for (const HalfEdge h : spokes(from)) {
        if (target(h) == to) return true;
    }
    return false;
}

void EditableMesh::pair(HalfEdge h, HalfEdge g, double crease) {
    twin_[h] = g;
    twin_[g] = h;
    crease_[h] = crease_[g] = crease;
}

void EditableMesh::take_over(HalfEdge fresh, HalfEdge old) { pair(fresh, twin_[old], crease_[old]); }

std::uint32_t EditableMesh::split(HalfEdge h, const Vec3& place) {
    const HalfEdge g = twin_[h];
    const std::uint32_t b = target(h), c = origin(prev(h)), d = origin(prev(g));
    const std::uint32_t m = mesh_.vertex_count();
    mesh_.positions.push_back(place);
    const HalfEdge left = 3 * mesh_.face_count(), right = left + 3;
    mesh_.faces.push_back({m, b, c});
    mesh_.faces.push_back({b, m, d});
    twin_.resize(twin_.size() + 6, kNone);
    crease_.resize(twin_.size(), kNoCrease);
    take_over(left + 1, next(h));   // b -> c
    take_over(right + 2, prev(g));  // d -> b
    mesh_.faces[face_of(h)][next(h) % 3] = m;
    mesh_.faces[face_of(g)][g % 3] = m;
    pair(left, right, crease_[h]);        // m -> b
    pair(next(h), left + 2, kNoCrease);   // m -> c
    pair(prev(g), right + 1, kNoCrease);  // d -> m
    outgoing_.push_back(left);
    outgoing_[b] = left + 1;
    valence_.push_back(4);
    ++valence_[c];
    ++valence_[d];
    return m;
}

void EditableMesh::turn(HalfEdge h) {
    const HalfEdge g = twin_[h];
    const std::uint32_t a = origin(h), b = origin(g), c = origin(prev(h)), d = origin(prev(g));
    const HalfEdge bc = next(h), ca = prev(h), ad = next(g), db = prev(g);
    turn_counter_clockwise(mesh_, twin_, h);
    for (const HalfEdge side : {bc, ca, ad, db}) crease_[side] = crease_[twin_[side]];
    outgoing_[a] = ca;
    outgoing_[b] = db;
    outgoing_[c] = g;
    outgoing_[d] = h;
    --valence_[a];
    --valence_[b];
    ++valence_[c];
    ++valence_[d];
}

std::vector<SharpEdge> EditableMesh::creases() const {
    std::vector<SharpEdge> all;
    for (HalfEdge h = 0; h < twin_.size(); ++h) {
        if (h < twin_[h] && is_crease(h)) all.push_back({origin(h), target(h), crease_[h]});
    }
    return all;
}

std::vector<SharpEdge> with_ghosts(std::vector<SharpEdge> creases, std::uint32_t ghosts) {
    for (SharpEdge& crease : creases) {
        crease.a += ghosts;
        crease.b += ghosts;
    }
    return creases;
}

std::vector<SharpEdge> without_ghosts(std::vector<SharpEdge> creases, std::uint32_t ghosts) {
    for (SharpEdge& crease : creases) {
        crease.a -= ghosts;
        crease.b -= ghosts;
    }
    return creases;
}

}  // namespace vsplit
