#include "simplify/collapse_log.h"

#include <algorithm>

namespace vsplit {
namespace {

/// Where each half-edge goes: faces of the base mesh keep their corners' order, faces that come back start at the corner given.
class Renumbering {
public:
    explicit Renumbering(HalfEdge half_edges) : first_(half_edges / 3, kNone) {}

    /// The face of `first_corner` becomes face `number`, which starts at that corner.
    void set_face(HalfEdge first_corner, std::uint32_t number) {
        first_[face_of(first_corner)] = 3 * number + (3 - first_corner % 3) % 3;
    }
    /// first_ holds where corner 0 of the old face went; the others follow in order.
    [[nodiscard]] HalfEdge operator[](HalfEdge h) const {
        const HalfEdge zero = first_[face_of(h)];
        return zero - zero % 3 + (zero + h) % 3;
    }

private:
    std::vector<HalfEdge> first_;
};

}  // namespace

void CollapseLog::record(const HalfEdgeMesh& mesh, const EdgeStar& star) {
    const std::uint32_t i = mesh.origin(star.ij);
    const std::uint32_t j = mesh.origin(star.ji);
    entries_.push_back({star.ij, star.ji, star.jb, j, mesh.valence(j) - 2, mesh.position(i), mesh.position(j)});
}

MultiresMesh CollapseLog::build(const HalfEdgeMesh& mesh) {
    MultiresMesh mrr;
    std::vector<std::uint32_t> vertex(mesh.vertex_count(), kNone);
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        if (mesh.outgoing(v) == kNone) continue;
        vertex[v] = mrr.base.vertex_count();
        mrr.base.positions.push_back(mesh.position(v));
    }
    Renumbering renumbered(mesh.half_edge_count());
    for (HalfEdge h = 0; h < mesh.half_edge_count(); h += 3) {
        if (mesh.removed(h)) continue;
        renumbered.set_face(h, mrr.base.face_count());
        mrr.base.faces.push_back({vertex[mesh.origin(h)], vertex[mesh.origin(h + 1)], vertex[mesh.origin(h + 2)]});
    }
    mrr.splits.reserve(entries_.size());
    std::reverse(entries_.begin(), entries_.end());
    for (const Entry& entry : entries_) {
        const std::uint32_t first_face = mrr.faces_at(mrr.splits.size());
        // The anchor's face was alive when the collapse was made, so it is numbered by now.
        mrr.splits.push_back({renumbered[entry.anchor], entry.steps, entry.kept_at, entry.removed_at});
        renumbered.set_face(entry.ij, first_face);
        renumbered.set_face(entry.ji, first_face + 1);
    }
    entries_ = {};
    return mrr;
}

}  // namespace vsplit
