#include "mesh/turn_edge.h"

namespace vsplit {
namespace {

void pair(std::vector<HalfEdge>& twin, HalfEdge h, HalfEdge g) {
    twin[h] = g;
    twin[g] = h;
}

std::uint32_t& corner(TriangleMesh& mesh, HalfEdge h) { return mesh.faces[face_of(h)][h % 3]; }

}  // namespace

void turn_counter_clockwise(TriangleMesh& mesh, std::vector<HalfEdge>& twin, HalfEdge h) {
    const HalfEdge g = twin[h];
    const HalfEdge bc = next(h), ca = prev(h), ad = next(g), db = prev(g);
    const std::uint32_t a = origin(mesh, h), b = origin(mesh, g), c = origin(mesh, ca), d = origin(mesh, db);
    const HalfEdge cb = twin[bc], ac = twin[ca], da = twin[ad], bd = twin[db];
    corner(mesh, h) = d;
    corner(mesh, bc) = c;
    corner(mesh, ca) = a;
    corner(mesh, g) = c;
    corner(mesh, ad) = d;
    corner(mesh, db) = b;
    pair(twin, bc, ac);  // now c -> a
    pair(twin, ca, da);  // now a -> d
    pair(twin, ad, bd);  // now d -> b
    pair(twin, db, cb);  // now b -> c
}

void turn_clockwise(TriangleMesh& mesh, std::vector<HalfEdge>& twin, HalfEdge h) {
    const HalfEdge g = twin[h];
    const HalfEdge qr = next(h), rp = prev(h), ps = next(g), sq = prev(g);
    const std::uint32_t p = origin(mesh, h), q = origin(mesh, g), r = origin(mesh, rp), s = origin(mesh, sq);
    const HalfEdge rq = twin[qr], pr = twin[rp], sp = twin[ps], qs = twin[sq];
    corner(mesh, h) = r;
    corner(mesh, qr) = s;
    corner(mesh, rp) = q;
    corner(mesh, g) = s;
    corner(mesh, ps) = r;
    corner(mesh, sq) = p;
    pair(twin, qr, qs);  // now s -> q
    pair(twin, rp, rq);  // now q -> r
    pair(twin, ps, pr);  // now r -> p
    pair(twin, sq, sp);  // now p -> s
}

}  // namespace vsplit
