#include "simplify/polish.h"

namespace vsplit {
namespace {

/// Faces of less stretch are lifted one by one, whatever it does to the mean.
constexpr double kLiftGoal = 0.72;

constexpr std::uint32_t kLookEvery = 1024;  // vertices, between two looks for a cancel

}  // namespace

template <class Move>
void Polisher::move_all(const ExecutionContext& context, Move move) {
    flipper_.flip_all();
    for (std::uint32_t v = 0; v < mesh_.vertex_count(); ++v) {
        if (v % kLookEvery == 0 && context.cancelled()) return;
        if (mesh_.outgoing(v) != kNone) move(v);
    }
}

void Polisher::polish(int relaxations, int lifts, const ExecutionContext& context) {
    for (int round = 0; round < relaxations && !context.cancelled(); ++round) {
        move_all(context, [this](std::uint32_t v) { mover_.relax(v); });
    }
    for (int round = 0; round < lifts && !context.cancelled(); ++round) {
        move_all(context, [this](std::uint32_t v) { mover_.lift(v, kLiftGoal); });
    }
    if (!context.cancelled()) flipper_.flip_all();
}

}  // namespace vsplit
