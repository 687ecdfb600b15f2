#include "simplify/half_edge_mesh.h"

#include "base/huge_pages.h"
#include "vsplit/mrr/multires_mesh.h"

namespace vsplit {

// Finding twins takes more memory than there is left for them and the rest: it comes first.
HalfEdgeMesh::HalfEdgeMesh(const TriangleMesh& mesh, std::uint32_t ghosts) : HalfEdgeMesh(mesh, half_edge_twins(mesh), ghosts) {}

HalfEdgeMesh::HalfEdgeMesh(const TriangleMesh& mesh, const std::vector<HalfEdge>& twins, std::uint32_t ghosts)
    : half_edges_(large_vector<Link>(mesh.faces.size() * 3)),
      creases_((mesh.faces.size() * 3 + 3) / 4, 0),
      outgoing_(large_vector<HalfEdge>(mesh.positions.size(), kNone)),
      valence_(large_vector<std::uint32_t>(mesh.positions.size())),
      changed_at_(mesh.positions.size(), 0),
      ghosts_(ghosts),
      live_faces_(mesh.face_count() - count_ghost_faces(mesh, ghosts)) {
    reserve_large(positions_, mesh.positions.size());
    positions_ = mesh.positions;
    for (HalfEdge h = 0; h < twins.size(); ++h) {
        const std::uint32_t v = vsplit::origin(mesh, h);
        half_edges_[h] = {v, twins[h]};
        if (outgoing_[v] == kNone) outgoing_[v] = h;
        ++valence_[v];
    }
}

EdgeStar HalfEdgeMesh::star(HalfEdge h) const {
    EdgeStar s;
    s.ij = h;
    s.je = next(h);
    s.ei = prev(h);
    s.ji = twin(h);
    s.ib = next(s.ji);
    s.bj = prev(s.ji);
    s.ej = twin(s.je);
    s.ie = twin(s.ei);
    s.bi = twin(s.ib);
    s.jb = twin(s.bj);
    return s;
}

bool HalfEdgeMesh::pinches(HalfEdge h) const {
    const HalfEdge g = twin(h);
    int shared = 0;
    for_each_outgoing(origin(h), [&](HalfEdge left) {
        for_each_outgoing(origin(g), [&](HalfEdge right) { shared += target(left) == target(right) ? 1 : 0; });
    });
    return shared != 2;
}

void HalfEdgeMesh::collapse(const EdgeStar& s, const Vec3& position) {
    const std::uint32_t i = origin(s.ij);
    const std::uint32_t j = origin(s.ji);
    const std::uint32_t e = origin(s.ei);
    const std::uint32_t b = origin(s.bj);
    for (HalfEdge corner = s.jb;; corner = turn(corner)) {
        half_edges_[corner].origin = i;
        if (prev(corner) == s.ej) break;
    }
    join(s.ej, s.ie);
    join(s.bi, s.jb);
    for (const HalfEdge gone : {s.ij, s.je, s.ei, s.ji, s.ib, s.bj}) half_edges_[gone].twin = kNone;
    outgoing_[i] = s.ie;
    outgoing_[e] = s.ej;
    outgoing_[b] = s.bi;
    outgoing_[j] = kNone;
    valence_[i] += valence_[j] - 4;
    valence_[j] = 0;
    --valence_[e];
    --valence_[b];
    positions_[i] = position;
    live_faces_.take(std::min(e, b) < ghosts_ ? 1 : 2);
}

void HalfEdgeMesh::flip(HalfEdge h) {
    const HalfEdge g = twin(h);
    const HalfEdge bc = next(h), ca = prev(h), ad = next(g), db = prev(g);
    const std::uint32_t a = origin(h), b = origin(g), c = origin(ca), d = origin(db);
    const HalfEdge cb = twin(bc), ac = twin(ca), da = twin(ad), bd = twin(db);
    half_edges_[h].origin = d;
    half_edges_[bc].origin = c;
    half_edges_[ca].origin = a;
    half_edges_[g].origin = c;
    half_edges_[ad].origin = d;
    half_edges_[db].origin = b;
    const auto settle = [this](HalfEdge inside, HalfEdge outside) {
        pair(inside, outside);
        put_mark(inside, marks(outside));
    };
    settle(bc, ac);  // now c -> a
    settle(ca, da);  // now a -> d
    settle(ad, bd);  // now d -> b
    settle(db, cb);  // now b -> c
    outgoing_[a] = ca;
    outgoing_[b] = db;
    outgoing_[c] = g;
    outgoing_[d] = h;
    tick();
    for (const std::uint32_t v : {a, b, c, d}) touch(v);
    --valence_[a];
    --valence_[b];
    ++valence_[c];
    ++valence_[d];
}

}  // namespace vsplit
