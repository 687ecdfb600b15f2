#include "simplify/polish.h"

namespace vsplit {
namespace {

/// Faces of less stretch are lifted one by one, whatever it does to the mean.
constexpr double kLiftGoal = 0.72;

}  // namespace

template <class Move>
void Polisher::move_all(Move move) {
    for (std::uint32_t v = 0; v < mesh_.vertex_count(); ++v) {
        if (mesh_.outgoing(v) != kNone) move(v);
    }
}

void Polisher::polish(int relaxations, int lifts) {
    for (int round = 0; round < relaxations; ++round) {
        flipper_.flip_all();
        move_all([this](std::uint32_t v) { mover_.relax(v); });
    }
    for (int round = 0; round < lifts; ++round) {
        flipper_.flip_all();
        move_all([this](std::uint32_t v) { mover_.lift(v, kLiftGoal); });
    }
    flipper_.flip_all();
}

}  // namespace vsplit
