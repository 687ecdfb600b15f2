#include "simplify/mender.h"

namespace vsplit {
namespace {

constexpr std::uint32_t kLookEvery = 1024;  // faces, between two looks for a cancel

}  // namespace

bool Mender::is_broken(std::uint32_t face) const {
    if (!mesh_.visible(face)) return false;
    if (!limits_.bounds.shaped()) return state_.faces[face].stretch < limits_.bounds.min_stretch;
    const auto at = [&](HalfEdge h) { return mesh_.position(mesh_.origin(h)); };
    return limits_.bounds.excess({at(3 * face), at(3 * face + 1), at(3 * face + 2)}).sum > 0;
}

bool Mender::relieve_vertices() {
    bool changed = false;
    for (std::uint32_t v = 0; v < mesh_.vertex_count(); ++v) {
        if (!state_.border.is_ghost(v) && mesh_.valence(v) > limits_.max_valence) changed |= flipper_.relieve(v);
    }
    return changed;
}

bool Mender::mend_face(std::uint32_t face, bool may_move) {
    if (flipper_.mend(face)) return true;
    bool changed = false;
    for (HalfEdge h = 3 * face; may_move && h < 3 * face + 3 && is_broken(face); ++h) changed |= mover_.mend(mesh_.origin(h));
    return changed;
}

bool Mender::mend_faces(bool may_move, const ExecutionContext& context) {
    bool changed = false;
    for (std::uint32_t face = 0; 3 * face < mesh_.half_edge_count(); ++face) {
        if (face % kLookEvery == 0 && context.cancelled()) return false;
        if (is_broken(face)) changed |= mend_face(face, may_move);
    }
    return changed;
}

void Mender::mend(int rounds, bool may_move, const ExecutionContext& context) {
    for (int round = 0; round < rounds && !context.cancelled(); ++round) {
        bool changed = relieve_vertices();
        if (may_move || limits_.bounds.shaped()) changed |= mend_faces(may_move, context);
        if (!changed) return;
    }
}

}  // namespace vsplit
