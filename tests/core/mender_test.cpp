#include "simplify/mender.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/core/meshes.h"
#include "tests/core/polishing.h"
#include "vsplit/quality/mesh_quality.h"

namespace vsplit::test {
namespace {

constexpr double kDegree = 0.017453292519943295;

Excess excess_of(const TriangleMesh& mesh, const FaceBounds& bounds) {
    Excess all;
    for (const Triangle& t : mesh.faces)
        all.add(bounds.excess({mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]}));
    return all;
}

std::uint32_t most_edges(const HalfEdgeMesh& mesh) {
    std::uint32_t most = 0;
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) most = std::max(most, mesh.valence(v));
    return most;
}

void mend(Polishing& p, const PolishLimits& limits, bool may_move) {
    const ExecutionContext context;
    EdgeFlipper flipper(p.mesh, p.state, p.log, {}, limits);
    VertexMover mover(p.mesh, p.state, p.log, {}, limits);
    Mender(p.mesh, p.state, flipper, mover, limits).mend(8, may_move, context);
}

TEST(MenderTest, WhatKeepsItsBoundsStaysBitForBit) {
    Polishing p(icosphere(3), 1e-3);
    const TriangleMesh before = p.now();
    PolishLimits limits = p.limits();
    limits.max_valence = 6;
    limits.bounds.min_stretch = 0.5;
    limits.bounds.min_sine = std::sin(40 * kDegree);
    mend(p, limits, true);
    EXPECT_EQ(p.now(), before);
}

TEST(MenderTest, FlipsAndMovesLessenWhatIsBrokenAndBreakNothingElse) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
        for (const bool may_move : {false, true}) {
            Polishing p(jittered_cube(10, 0.15, seed), 1e-3);
            PolishLimits limits = p.limits();
            limits.max_valence = 8;
            limits.bounds.min_stretch = 0.5;
            limits.bounds.min_sine = std::sin(35 * kDegree);
            limits.bounds.min_cosine = std::cos(100 * kDegree);
            const Excess before = excess_of(p.now(), limits.bounds);
            ASSERT_FALSE(before.none());
            mend(p, limits, may_move);
            const Excess after = excess_of(p.now(), limits.bounds);
            EXPECT_LT(after.sum, may_move ? 0.2 * before.sum : before.sum);
            EXPECT_LE(after.worst, before.worst);
            EXPECT_LE(most_edges(p.mesh), 8U);
            expect_consistent(p);
            EXPECT_NEAR(enclosed_volume(p.now()), 1, 1e-6) << "the faces of a cube are flat, and its edges are creases";
        }
    }
}

TEST(MenderTest, ACreaseThatWentFlatIsFlippedUnlessItCountsWithoutABend) {
    for (const bool kept_flat : {false, true}) {
        Polishing p(jittered_cube(10, 0.15, 1), 1e-3);
        PolishLimits limits = p.limits();
        limits.crease_cosine = std::cos(40 * kDegree);
        limits.bounds.min_stretch = 0.5;
        limits.bounds.min_sine = std::sin(35 * kDegree);
        for (const HalfEdge h : p.edges()) {
            if (!p.mesh.is_crease(h)) kept_flat ? p.mesh.mark_kept_flat(h) : p.mesh.mark_crease(h);
        }
        const TriangleMesh before = p.now();
        mend(p, limits, false);
        if (kept_flat) {
            EXPECT_EQ(p.now(), before);
        } else {
            EXPECT_LT(excess_of(p.now(), limits.bounds).sum, 0.9 * excess_of(before, limits.bounds).sum);
            EXPECT_NEAR(enclosed_volume(p.now()), 1, 1e-6) << "the edges of the cube stay";
        }
        expect_consistent(p);
    }
}

TEST(MenderTest, TheLastStepMayBeAsSmallAsItLikes) {
    Polishing p(jittered_cube(10, 0.15, 2), 1e-3);
    PolishLimits limits = p.limits();
    const auto least = [](const TriangleMesh& mesh) { return measure_quality(mesh).stretch_min; };
    // A bound that the worst face misses by less than a gain that is worth a record.
    limits.bounds.min_stretch = least(p.now()) + kLeastGain / 4;
    mend(p, limits, true);
    EXPECT_GE(least(p.now()), limits.bounds.min_stretch);
}

TEST(MenderTest, VerticesOfTooManyEdgesGiveSomeToTheirNeighbours) {
    // Collapsing every edge of one vertex of a flat grid into it in turn makes a vertex of many edges.
    Polishing p(jittered_cube(10, 0, 1), 1e-3);
    std::uint32_t hub = 0;
    while (p.mesh.valence(hub) != 6) ++hub;
    for (int n = 0; n < 3; ++n) {
        HalfEdge best = kNone;
        p.mesh.for_each_outgoing(hub, [&](HalfEdge h) {
            if (best == kNone || p.mesh.valence(p.mesh.target(h)) > p.mesh.valence(p.mesh.target(best))) best = h;
        });
        p.mesh.collapse(p.mesh.star(best), p.mesh.position(hub));
    }
    for (std::uint32_t f = 0; f < p.state.faces.size(); ++f) {
        if (!p.mesh.removed(3 * f)) p.state.faces[f] = p.measured(f);
    }
    ASSERT_GT(p.mesh.valence(hub), 8U);
    PolishLimits limits = p.limits();
    limits.max_valence = 8;
    mend(p, limits, false);
    EXPECT_LE(most_edges(p.mesh), 8U);
    expect_consistent(p);
}

}  // namespace
}  // namespace vsplit::test
