#include "simplify/edge_queue.h"

#include <algorithm>

#include "base/huge_pages.h"

namespace vsplit {
namespace {

constexpr std::size_t kLanes = 4;

/// Lane by lane, so that the compiler can keep the lanes in vectors.
template <std::size_t Players>
double largest(const double* players) {
    std::array<double, kLanes> best{};
    std::copy_n(players, kLanes, best.begin());
    for (std::size_t i = kLanes; i < Players; i += kLanes) {
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            best[lane] = players[i + lane] > best[lane] ? players[i + lane] : best[lane];
        }
    }
    return *std::max_element(best.begin(), best.end());
}

/// The first of the players that has it, one of them does. Several at a step, since where it ends cannot be foretold.
std::size_t first_with(const double* players, double priority) {
    const auto has = [=](std::size_t i) { return static_cast<int>(players[i] == priority); };
    std::size_t i = 0;
    while ((has(i) | has(i + 1) | has(i + 2) | has(i + 3)) == 0) i += kLanes;
    while (has(i) == 0) ++i;
    return i;
}

}  // namespace

EdgeQueue::EdgeQueue(HalfEdge first, HalfEdge last) : first_(first) {
    for (std::size_t players = last - first;;) {
        const std::size_t matches = std::max<std::size_t>(1, (players + kPlayers - 1) / kPlayers);
        levels_.push_back({large_vector(matches * kPlayers, kAbsent), {}, std::vector<bool>(matches, false)});
        if (matches == 1) break;
        players = matches;
    }
}

void EdgeQueue::clear() {
    for (Level& level : levels_) {
        std::fill(level.best.begin(), level.best.end(), kAbsent);
        std::fill(level.is_open.begin(), level.is_open.end(), false);
        level.open.clear();
    }
}

void EdgeQueue::open_all() {
    for (std::size_t match = 0; match < levels_[0].is_open.size(); ++match) touch(0, match);
}

void EdgeQueue::play_open_matches() {
    for (std::size_t level = 0; level + 1 < levels_.size(); ++level) {
        Level& at = levels_[level];
        for (const std::uint32_t match : at.open) {
            at.is_open[match] = false;
            const double winner = largest<kPlayers>(&at.best[match * kPlayers]);
            double& known = levels_[level + 1].best[match];
            if (known == winner) continue;
            known = winner;
            touch(level + 1, match / kPlayers);
        }
        at.open.clear();
    }
}

HalfEdge EdgeQueue::top() {
    play_open_matches();
    const double most = largest<kPlayers>(levels_.back().best.data());
    if (most < 0) return kNone;
    std::size_t match = 0;
    for (std::size_t level = levels_.size(); level-- > 0;) {
        match = match * kPlayers + first_with(&levels_[level].best[match * kPlayers], most);
    }
    return first_ + static_cast<HalfEdge>(match);
}

}  // namespace vsplit
