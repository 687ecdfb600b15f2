#pragma once

#include "simplify/edge_flipper.h"
#include "simplify/vertex_mover.h"
#include "vsplit/base/execution_context.h"

namespace vsplit {

/// Mends what breaks a bound of control by flips and moves: vertices of too many edges, faces out of shape. Touches nothing where
/// all bounds hold. In a fixed order on one thread, so the same for any number of them.
class Mender {
public:
    Mender(const HalfEdgeMesh& mesh, const LocalState& state, EdgeFlipper& flipper, VertexMover& mover,
           const PolishLimits& limits)
        : mesh_(mesh), state_(state), flipper_(flipper), mover_(mover), limits_(limits) {}

    /// At most so many rounds, until nothing more helps. Unless it `may_move` vertices it leaves faces alone that break the bound
    /// on stretch where that is the only one: the strict mode mends those by collapses. Stops early when cancelled. O(faces)
    /// where little is broken.
    void mend(int rounds, bool may_move, const ExecutionContext& context);

private:
    [[nodiscard]] bool relieve_vertices();
    [[nodiscard]] bool mend_faces(bool may_move, const ExecutionContext& context);
    [[nodiscard]] bool mend_face(std::uint32_t face, bool may_move);
    [[nodiscard]] bool is_broken(std::uint32_t face) const;

    const HalfEdgeMesh& mesh_;
    const LocalState& state_;
    EdgeFlipper& flipper_;
    VertexMover& mover_;
    const PolishLimits limits_;
};

}  // namespace vsplit
