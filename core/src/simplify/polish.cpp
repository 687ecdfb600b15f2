#include "simplify/polish.h"

#include <algorithm>
#include <span>

#include "simplify/log_in_parts.h"

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

struct Polisher::Hand {
    OwnGuards guards;
    EdgeFlipper flipper;
    VertexMover mover;

    Hand(Polisher& of, CollapseLog& log, const MeshParts& parts)
        : guards(of.guards_),
          flipper(of.mesh_, of.state_, log, guards.all(), of.limits_, &parts),
          mover(of.mesh_, of.state_, log, guards.all(), of.limits_) {}
};

void Polisher::flip_all() {
    const MeshParts parts(mesh_, shifted_ = !shifted_);
    parts.count() == 1 ? flipper_.flip_all() : flip_in_parts(parts);
}

void Polisher::flip_in_parts(const MeshParts& parts) {
    const std::uint32_t start = mesh_.clock();
    log_in_parts(parts, mesh_, log_, [&](std::size_t part, CollapseLog& log) {
        Hand(*this, log, parts).flipper.flip_within(parts.faces(part), flipper_.looked_at_all());
    });
    flipper_.flip_between(parts, start);
}

/// A vertex that the last round left where it was is left out while all is as it was then: it would stay again.
template <class Move>
void Polisher::move_in_parts(const MeshParts& parts, const ExecutionContext& context, Start& last, Move move) {
    const std::uint32_t start = mesh_.clock();
    const auto move_each = [&](std::span<const std::uint32_t> vertices, VertexMover& mover) {
        for (std::size_t n = 0; n < vertices.size(); ++n) {
            if (n % kLookEvery == 0 && context.cancelled()) return;
            if (!(last && is_as_tried(vertices[n], *last))) move(mover, vertices[n]);
        }
    };
    log_in_parts(parts, mesh_, log_, [&](std::size_t part, CollapseLog& log) {
        Hand hand(*this, log, parts);
        hand.flipper.flip_within(parts.faces(part), flipper_.looked_at_all());
        move_each(parts.interior(part), hand.mover);
    });
    flipper_.flip_between(parts, start);
    move_each(parts.between(), mover_);
    last = start;
}

template <class Move>
void Polisher::move_all(const ExecutionContext& context, Start& last, Move move) {
    const MeshParts parts = MeshParts(mesh_, shifted_ = !shifted_);
    if (parts.count() > 1) return move_in_parts(parts, context, last, move);
    flipper_.flip_all();
    const std::uint32_t start = mesh_.clock();
    for (std::uint32_t v = 0; v < mesh_.vertex_count(); ++v) {
        if (v % kLookEvery == 0 && context.cancelled()) return;
        if (mesh_.outgoing(v) != kNone && !(last && is_as_tried(v, *last))) move(mover_, v);
    }
    last = start;
}

void Polisher::polish(int relaxations, VertexMover::Moves moves, int lifts, const ExecutionContext& context) {
    Start& relaxed = relaxed_.at(static_cast<std::size_t>(moves));
    for (int round = 0; round < relaxations && !context.cancelled(); ++round) {
        move_all(context, relaxed, [moves](VertexMover& mover, std::uint32_t v) { mover.relax(v, moves); });
    }
    for (int round = 0; round < lifts && !context.cancelled(); ++round) {
        move_all(context, lifted_, [](VertexMover& mover, std::uint32_t v) { mover.lift(v, kLiftGoal); });
    }
    if (!context.cancelled()) flip_all();
}

}  // namespace vsplit
