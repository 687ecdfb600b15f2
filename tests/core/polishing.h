#pragma once

#include <cstdint>
#include <vector>

#include "simplify/collapse_log.h"
#include "simplify/half_edge_mesh.h"
#include "simplify/local_state.h"
#include "simplify/polish_limits.h"
#include "tests/core/edited_mrr.h"

/// What flips and moves are tried on.
namespace vsplit::test {

/// What the simplifier would get for `mesh` as it is, without subdivision; tolerance as a share of the diagonal.
[[nodiscard]] SimplifyInput simplify_input(const TriangleMesh& mesh, double tolerance_share);

/// noisy_cube without noise, its vertices moved by up to `share` of a cell within their side or along their edge of the cube: the
/// surface is exactly the cube's. \pre share at most 0.15, so that no face turns over.
[[nodiscard]] TriangleMesh jittered_cube(std::uint32_t cells, double share, std::uint64_t seed);

/// The parts of a simplifier, creases marked as it marks them.
struct Polishing {
    SimplifyInput input;
    HalfEdgeMesh mesh;
    LocalState state;
    CollapseLog log;

    Polishing(const TriangleMesh& source, double tolerance_share);

    [[nodiscard]] PolishLimits limits() const { return {.centre = input.centre, .tolerance = input.tolerance}; }
    /// The live faces, vertices as numbered here.
    [[nodiscard]] TriangleMesh now() const;
    /// Each live edge once, by its number.
    [[nodiscard]] std::vector<HalfEdge> edges() const;
    [[nodiscard]] bool joined(std::uint32_t u, std::uint32_t v) const;
    /// Figures of the corners of the face of h as they stand.
    [[nodiscard]] FaceState measured(std::uint32_t face) const;
};

/// Fails where the state is not what measuring every live face anew gives, and where the mesh is no closed manifold without
/// double edges and vertices of valence under 3.
void expect_consistent(const Polishing& p);

}  // namespace vsplit::test
