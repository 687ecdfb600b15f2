#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "mesh/half_edges.h"

namespace vsplit {

/// Edges by priority, largest first, ties by smaller edge number: a tournament over edge numbers with 32 players a match.
///
/// A collapse changes some forty edges, which are near each other on the surface and so, with a mesh ordered along a curve, in
/// number: they share a few matches, which are played again when the winner is asked for. A heap would go to forty places all
/// over memory. Setting is O(1), the winner O(changed matches * log(edges)).
class EdgeQueue {
public:
    /// For edges that go by numbers from `first` on and under `last`.
    EdgeQueue(HalfEdge first, HalfEdge last);

    /// Inserts the edge or changes its priority. \pre priority >= 0.
    void set(HalfEdge edge, double priority) {
        levels_[0].best[edge - first_] = priority;
        touch(0, (edge - first_) / kPlayers);
    }

    /// `set` for many, from any thread, each for other edges; `open_all` must follow. \pre the edge is not there.
    void enter(HalfEdge edge, double priority) { levels_[0].best[edge - first_] = priority; }
    void open_all();

    /// Drops the edge if it is there.
    void erase(HalfEdge edge) {
        levels_[0].best[edge - first_] = kAbsent;
        touch(0, (edge - first_) / kPlayers);
    }

    /// Drops the edge and notes it, until it is set or erased. O(1).
    void set_aside(HalfEdge edge) {
        levels_[0].best[edge - first_] = kAside;
        touch(0, (edge - first_) / kPlayers);
    }
    [[nodiscard]] bool is_aside(HalfEdge edge) const { return levels_[0].best[edge - first_] == kAside; }

    /// `set_aside` for many, as `enter` is `set`.
    void enter_aside(HalfEdge edge) { levels_[0].best[edge - first_] = kAside; }

    /// Drops all. O(edges).
    void clear();

    /// The edge of largest priority, or kNone when there is none.
    [[nodiscard]] HalfEdge top();

    /// visit(priority) for each edge that is there.
    template <class Visit>
    void for_each(Visit visit) const {
        for (const double priority : levels_[0].best) {
            if (priority >= 0) visit(priority);
        }
    }

    [[nodiscard]] double priority(HalfEdge edge) const { return levels_[0].best[edge - first_]; }

private:
    static constexpr std::size_t kPlayers = 32;
    static constexpr double kAbsent = -1, kAside = -2;

    /// Players of one level and the matches among them whose result is open.
    struct Level {
        std::vector<double> best;         // of each player; a multiple of kPlayers, filled up with kAbsent
        std::vector<std::uint32_t> open;  // matches to play again
        std::vector<bool> is_open;
    };

    void touch(std::size_t level, std::size_t match) {
        Level& at = levels_[level];
        if (at.is_open[match]) return;
        at.is_open[match] = true;
        at.open.push_back(static_cast<std::uint32_t>(match));
    }
    void play_open_matches();

    HalfEdge first_ = 0;
    std::vector<Level> levels_;  // 0: edges; the last: one match
};

}  // namespace vsplit
