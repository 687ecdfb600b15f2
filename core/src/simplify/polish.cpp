#include "simplify/polish.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

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
    std::optional<DeviationGuard> surface;
    std::optional<CreaseGuard> creases;
    EdgeFlipper flipper;
    VertexMover mover;

    Hand(Polisher& of, CollapseLog& log)
        : surface(of.guards_.surface != nullptr ? std::optional(*of.guards_.surface) : std::nullopt),
          creases(of.guards_.creases != nullptr ? std::optional(*of.guards_.creases) : std::nullopt),
          flipper(of.mesh_, of.state_, log, guards(), of.limits_),
          mover(of.mesh_, of.state_, log, guards(), of.limits_) {}

    [[nodiscard]] Guards guards() { return {surface ? &*surface : nullptr, creases ? &*creases : nullptr}; }
};

/// `work(hand, part)` for each part on some thread; then the log has what all did, part by part.
template <class Work>
void Polisher::in_parts(const MeshParts& parts, Work work) {
    std::vector<CollapseLog> logs;
    for (std::size_t part = 0; part < parts.count(); ++part) logs.push_back(log_.fork(mesh_));
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, parts.count(), 1),
        [&](const tbb::blocked_range<std::size_t>& range) {
            for (std::size_t part = range.begin(); part < range.end(); ++part) {
                Hand hand(*this, logs[part]);
                work(hand, part);
            }
        },
        tbb::simple_partitioner());
    for (CollapseLog& log : logs) log_.append(std::move(log));
}

void Polisher::flip_all() {
    const MeshParts parts(mesh_, shifted_ = !shifted_);
    parts.count() == 1 ? flipper_.flip_all() : flip_in_parts(parts);
}

void Polisher::flip_in_parts(const MeshParts& parts) {
    const std::uint32_t start = mesh_.clock();
    in_parts(parts, [&](Hand& hand, std::size_t part) { hand.flipper.flip_within(parts, part, flipper_.looked_at_all()); });
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
    in_parts(parts, [&](Hand& hand, std::size_t part) {
        hand.flipper.flip_within(parts, part, flipper_.looked_at_all());
        move_each(parts.interior(part), hand.mover);
    });
    flipper_.flip_between(parts, start);
    move_each(parts.between(), mover_);
    last = start;
}

template <class Move>
void Polisher::move_all(const ExecutionContext& context, Start& last, Move move) {
    const MeshParts parts(mesh_, shifted_ = !shifted_);
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
