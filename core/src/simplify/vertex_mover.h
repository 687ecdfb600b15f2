#pragma once

#include <cstdint>

#include "simplify/collapse_log.h"
#include "simplify/crease_replacement.h"
#include "simplify/fan.h"
#include "simplify/fan_replacement.h"
#include "simplify/guards.h"
#include "simplify/half_edge_mesh.h"
#include "simplify/local_state.h"
#include "simplify/polish_limits.h"

namespace vsplit {

/// Moves vertices along the surface where the faces around them get a better shape. A vertex stays at the minimum of its quadric
/// across the surface, so one on a crease moves along it and a corner not at all; one on an open boundary moves along that, and
/// not at all where it is a corner or frozen. No bound breaks that held.
/// Tells the log.
class VertexMover {
public:
    VertexMover(HalfEdgeMesh& mesh, LocalState& state, CollapseLog& log, const Guards& guards, const PolishLimits& limits)
        : mesh_(mesh),
          state_(state),
          log_(log),
          guard_(guards.surface),
          creases_(mesh, state, guards.creases, limits.crease_cosine),
          limits_(limits) {}

    /// Which moves `relax` makes: all that better the shape, or those that are worth a record.
    enum class Moves { kAll, kWorthwhile };

    /// Towards where the faces around v are nearest to equilateral, in the mean of squares. O(valence).
    void relax(std::uint32_t v, Moves moves = Moves::kAll);

    /// Where a face around v has a stretch under `goal`, searches nearby for a place that raises the least one. O(valence).
    void lift(std::uint32_t v, double goal);

    /// Where a face around v breaks a bound, searches nearby for a place where they lack less to keep them. Whether v moved.
    /// O(valence).
    bool mend(std::uint32_t v);

private:
    [[nodiscard]] bool gather_star(std::uint32_t v);
    [[nodiscard]] Vec3 onto_surface(const Vec3& wanted) const;
    [[nodiscard]] Vec3 along_boundary(const Vec3& here, const Vec3& wanted) const;
    [[nodiscard]] Vec3 ideal() const;
    [[nodiscard]] bool admits(const Vec3& place);
    [[nodiscard]] bool sizes_admit(const Vec3& position) const;
    [[nodiscard]] bool keeps_bounds(const Vec3& position) const;
    /// Steps of a pattern to where value_at(position) is largest, each by a gain worth a record or up to `goal`. Whether the
    /// vertex moved.
    template <class Value>
    [[nodiscard]] bool search(std::uint32_t v, Value value_at, double goal);
    [[nodiscard]] bool put(std::uint32_t v, const Vec3& place);

    HalfEdgeMesh& mesh_;
    LocalState& state_;
    CollapseLog& log_;
    DeviationGuard* const guard_;
    CreaseReplacement creases_;
    const PolishLimits limits_;
    FanReplacement replacement_;
    // Of the vertex at hand:
    std::uint32_t vertex_ = 0;
    Fan star_;
    Fan::Shape shape_;            // by the last `admits`
    Vec3 normal_ = Vec3::Zero();  // of the surface, unit
    double steepness_ = 0;        // of the quadric along the normal; 0 on creases and boundaries, and with bounds on sizes
    bool is_curved_ = false;      // elsewhere, and the planes gathered are not one
    Quadric quadric_;
    double error_limit_ = 0;
    double size_limit_ = 0;
    double stretch_limit_ = 0;
    Excess excess_before_;  // where bounds beside that on stretch are given
};

}  // namespace vsplit
