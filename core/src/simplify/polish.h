#pragma once

#include <array>
#include <optional>

#include "simplify/edge_flipper.h"
#include "simplify/mender.h"
#include "simplify/mesh_parts.h"
#include "simplify/vertex_mover.h"
#include "vsplit/base/execution_context.h"

namespace vsplit {

/// Betters the shape of a mesh's faces without changing their number: rounds of flips and moves. Parts of a large mesh are
/// polished beside each other (MeshParts), then what lies between them; in a fixed order each, so the same for any number of
/// threads.
class Polisher {
public:
    Polisher(HalfEdgeMesh& mesh, LocalState& state, CollapseLog& log, const Guards& guards, const PolishLimits& limits)
        : mesh_(mesh),
          state_(state),
          log_(log),
          guards_(guards),
          limits_(limits),
          flipper_(mesh, state, log, guards, limits),
          mover_(mesh, state, log, guards, limits),
          mender_(mesh, state, flipper_, mover_, limits) {}

    /// `relaxations` rounds of `moves` for the mean shape, then `lifts` for the worst faces. Stops early when cancelled.
    /// O(faces * rounds).
    void polish(int relaxations, VertexMover::Moves moves, int lifts, const ExecutionContext& context);

    /// Mends what breaks a bound; see Mender.
    void mend(int rounds, bool may_move, const ExecutionContext& context) { mender_.mend(rounds, may_move, context); }

private:
    /// When a kind of move began its last round, by the mesh's clock.
    using Start = std::optional<std::uint32_t>;
    /// What one part is worked on with.
    struct Hand;
    template <class Move>
    void move_all(const ExecutionContext& context, Start& last, Move move);
    template <class Move>
    void move_in_parts(const MeshParts& parts, const ExecutionContext& context, Start& last, Move move);
    void flip_all();
    void flip_in_parts(const MeshParts& parts);
    [[nodiscard]] bool is_as_tried(std::uint32_t v, std::uint32_t start) const;

    HalfEdgeMesh& mesh_;
    LocalState& state_;
    CollapseLog& log_;
    const Guards guards_;
    const PolishLimits limits_;
    EdgeFlipper flipper_;
    VertexMover mover_;
    Mender mender_;
    std::array<Start, 2> relaxed_;  // by Moves
    Start lifted_;
    bool shifted_ = false;  // where the mesh was cut last
};

}  // namespace vsplit
