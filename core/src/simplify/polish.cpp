#include "simplify/polish.h"

#include <algorithm>

namespace vsplit {
namespace {

/// Faces of less stretch are lifted one by one, whatever it does to the mean.
constexpr double kLiftGoal = 0.72;

constexpr std::uint32_t kLookEvery = 1024;  // vertices, between two looks for a cancel

}  // namespace

/// Whether nothing that a move of v looks at has changed since: the faces at v, and across creases of its ring.
bool Polisher::is_as_tried(std::uint32_t v, std::uint32_t start) const {
    if (mesh_.changed_at(v) > start) return false;
    bool same = true;
    mesh_.for_each_outgoing(v, [&](HalfEdge h) {
        const HalfEdge side = next(h);
        if (mesh_.is_crease(side))
            same &= std::max(mesh_.changed_at(mesh_.origin(side)), mesh_.changed_at(mesh_.target(side))) <= start;
    });
    return same;
}

/// A vertex that the last round left where it was is left out while all is as it was then: it would stay again.
template <class Move>
void Polisher::move_all(const ExecutionContext& context, Start& last, Move move) {
    flipper_.flip_all();
    const std::uint32_t start = mesh_.clock();
    for (std::uint32_t v = 0; v < mesh_.vertex_count(); ++v) {
        if (v % kLookEvery == 0 && context.cancelled()) return;
        if (mesh_.outgoing(v) != kNone && !(last && is_as_tried(v, *last))) move(v);
    }
    last = start;
}

void Polisher::polish(int relaxations, VertexMover::Moves moves, int lifts, const ExecutionContext& context) {
    Start& relaxed = relaxed_.at(static_cast<std::size_t>(moves));
    for (int round = 0; round < relaxations && !context.cancelled(); ++round) {
        move_all(context, relaxed, [this, moves](std::uint32_t v) { mover_.relax(v, moves); });
    }
    for (int round = 0; round < lifts && !context.cancelled(); ++round) {
        move_all(context, lifted_, [this](std::uint32_t v) { mover_.lift(v, kLiftGoal); });
    }
    if (!context.cancelled()) flipper_.flip_all();
}

}  // namespace vsplit
