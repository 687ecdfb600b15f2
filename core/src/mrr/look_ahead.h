#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "mesh/corners.h"
#include "mesh/half_edges.h"
#include "vsplit/mrr/progressive_mesh.h"

namespace vsplit {

/// Asks for the memory around vertices before their turn comes, two rings wide: what comes after one of them often is beside it.
/// A mesh is walked from face to face, so memory that is far away can be asked for only when that of the step before is there.
/// Therefore some are under way at a time, and each goes a step at every turn. Beyond the caches that is most of the time.
class LookAhead {
public:
    /// \pre mesh outlives this.
    explicit LookAhead(const ProgressiveMesh& mesh) : mesh_(mesh) {}

    /// The vertices in the order of their turns, by number or by a corner. Those that are not there yet when they are looked for
    /// are left out.
    enum class By : std::uint8_t { kVertex, kCorner };
    void begin(By by, std::vector<std::uint32_t> starts) {
        by_ = by;
        starts_ = std::move(starts);
        starts_.resize(starts_.size() + kAhead, 0);
        next_ = 0;
        walkers_ = {};
        for (std::size_t n = 0; n < kAhead; ++n) set_out(n);
    }

    /// The turn of the next of them has come. O(1).
    void advance() {
        for (std::size_t n = 1; n + 1 < kAhead; ++n) step(walkers_[(next_ + n) % kSlots]);
        Walker& second = walkers_[(next_ + kAhead - 1) % kSlots];
        if (by_ == By::kVertex) {
            second.corner = mesh_.corner_of(second.start);
            mesh_.prefetch_corner(second.corner);
        } else {
            second.corner = second.start;
            mesh_.prefetch_position(origin(mesh_.mesh(), second.corner));
        }
        set_out(next_++ + kAhead);
    }

private:
    static constexpr std::size_t kAhead = 10;  // two less go around most vertices that are split
    static constexpr std::size_t kSlots = 16;  // a power of two, no less than that

    /// The mesh changes under it, so it may miss something; it reads nothing that is not there. One that has nothing to look at
    /// goes around vertex 0: to do that is cheaper than to ask.
    struct Walker {
        std::uint32_t start = 0;
        HalfEdge corner = 0;  ///< at the vertex; its memory has been asked for
        HalfEdge beyond = 0;  ///< in the face beyond the one before
    };

    void set_out(std::size_t n) {
        Walker& walker = walkers_[n % kSlots];
        const std::size_t count = by_ == By::kVertex ? mesh_.mesh().positions.size() : mesh_.twins().size();
        walker.start = starts_[n] < count ? starts_[n] : 0;
        if (by_ == By::kVertex) {
            mesh_.prefetch_corner_of(walker.start);
            mesh_.prefetch_position(walker.start);
        } else {
            mesh_.prefetch_corner(walker.start);
        }
    }

    void step(Walker& walker) {
        const std::uint32_t* const vertex_at = corners_of(mesh_.mesh().faces);
        const HalfEdge* const twins = mesh_.twins().data();
        const HalfEdge across = next(walker.corner);
        mesh_.prefetch_position(vertex_at[across]);
        mesh_.prefetch_position(vertex_at[prev(walker.beyond)]);
        walker.beyond = twins[across];
        mesh_.prefetch_corner(walker.beyond);
        walker.corner = twins[prev(walker.corner)];
        mesh_.prefetch_corner(walker.corner);
    }

    const ProgressiveMesh& mesh_;
    By by_ = By::kVertex;
    std::vector<std::uint32_t> starts_;
    std::size_t next_ = 0;
    std::array<Walker, kSlots> walkers_{};
};

}  // namespace vsplit
