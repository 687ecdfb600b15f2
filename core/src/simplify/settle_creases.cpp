#include "simplify/settle_creases.h"

#include <cmath>
#include <vector>

namespace vsplit {
namespace {

template <class Visit>
void for_each_visible_edge(const HalfEdgeMesh& mesh, Visit visit) {
    for (HalfEdge h = 0; h < mesh.half_edge_count(); ++h) {
        if (mesh.removed(h) || mesh.edge_of(h) != h) continue;
        if (mesh.visible(face_of(h)) && mesh.visible(face_of(mesh.twin(h)))) visit(h);
    }
}

}  // namespace

void settle_creases(HalfEdgeMesh& mesh, const LocalState& state, CreaseGuard& guard, double crease_cosine) {
    const double half_cosine = std::sqrt((1 + crease_cosine) / 2);
    const auto cosine = [&](HalfEdge h) -> double {
        return state.faces[face_of(h)].normal.dot(state.faces[face_of(mesh.twin(h))].normal);
    };
    std::vector<CreaseGuard::NewCrease> bends;
    for_each_visible_edge(mesh, [&](HalfEdge h) {
        if (mesh.is_kept_flat(h) || cosine(h) < crease_cosine)
            bends.push_back({h, mesh.position(mesh.origin(h)), mesh.position(mesh.target(h))});
    });
    guard.go_to_nearest(bends);
    for_each_visible_edge(mesh, [&](HalfEdge h) {
        const bool holds = guard.holds_points(h);
        if (holds && !mesh.is_crease(h)) mesh.mark_crease(h);
        if (!holds && mesh.is_crease(h) && !mesh.is_kept_flat(h) && cosine(h) >= half_cosine) mesh.unmark_crease(h);
    });
}

}  // namespace vsplit
