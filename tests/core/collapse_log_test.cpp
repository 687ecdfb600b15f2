#include "simplify/collapse_log.h"

#include <gtest/gtest.h>

#include "mesh/cap_boundaries.h"
#include "tests/core/edited_mrr.h"
#include "tests/core/meshes.h"
#include "vsplit/mesh/inspect.h"
#include "vsplit/mrr/progressive_mesh.h"

namespace vsplit::test {
namespace {

TEST(CollapseLogTest, EveryLevelIsTheMeshThatWas) {
    for (const TriangleMesh& mesh :
         {icosphere(2), torus(12, 8), plate_with_holes(2), joined(icosphere(1), cube_frame(), Vec3(10, 0, 0)), square(9),
          punctured(torus(16, 10), {0, 35, 70, 105}), punctured(icosphere(2), {0, 1, 2, 3})}) {
        const EditedMrr edited = edited_mrr(mesh, 100, mesh.face_count(), true);
        const MultiresMesh& mrr = edited.mrr;
        ASSERT_GT(mrr.levels(), 10U);
        ASSERT_EQ(edited.complexes.size(), mrr.levels() + 1);
        EXPECT_GT(mrr.records.flips().size(), 10U);
        EXPECT_GT(mrr.records.moves().size(), 10U);
        auto progressive = ProgressiveMesh::from_base(mrr.base, mrr.ghosts);
        ASSERT_TRUE(progressive) << progressive.error().message;
        const std::int32_t genus = inspect(cap_boundaries(mesh)->mesh).genus;
        for (std::size_t level = 0; level <= mrr.levels(); ++level) {
            const std::size_t now = progressive->records();
            const Status refined = progressive->refine(mrr.records.slice(now, mrr.record_of_level(level) - now));
            ASSERT_TRUE(refined) << refined.error().message;
            ASSERT_EQ(progressive->level(), level);
            const MeshReport report = inspect(progressive->mesh());
            ASSERT_TRUE(report.closed);
            ASSERT_EQ(report.genus, genus);
            ASSERT_EQ(unnumbered(progressive->mesh()), unnumbered(edited.complexes[mrr.levels() - level])) << level;
            ASSERT_EQ(progressive->visible().face_count(), mrr.faces_at(level));
            ASSERT_EQ(mrr.level_for(mrr.faces_at(level)), level);
        }
        EXPECT_EQ(progressive->border_splits(), mrr.border_splits);
        EXPECT_EQ(mrr.ghosts == 0, mrr.border_splits.empty());
        EXPECT_EQ(mrr.records.kinds().back(), RecordKind::kSplit);
    }
}

TEST(CollapseLogTest, OpenMeshesKeepTheirBoundaryLoops) {
    const TriangleMesh mesh = punctured(torus(16, 10), {0, 35, 70, 105});
    const MeshReport source = inspect(mesh);
    ASSERT_FALSE(source.closed);
    const EditedMrr edited = edited_mrr(mesh, 1000, 5);
    ASSERT_EQ(edited.mrr.ghosts, 4U);
    for (std::size_t level = 0; level <= edited.mrr.levels(); ++level) {
        const TriangleMesh visible = mesh_at(edited.mrr, level);
        ASSERT_TRUE(require_manifold(inspect(visible)));
        const Expected<CappedMesh> capped = cap_boundaries(visible);
        ASSERT_TRUE(capped);
        ASSERT_EQ(capped->ghosts, 4U) << level;
        ASSERT_EQ(inspect(capped->mesh).genus, 1);
    }
    EXPECT_EQ(edited.mrr.faces_max(), mesh.face_count());
    EXPECT_LT(edited.mrr.faces_min(), mesh.face_count() / 4);
}

/// One collapse on a sphere, then whatever a test does.
class CollapseLogStepTest : public ::testing::Test {
protected:
    void SetUp() override { collapse(0); }

    void collapse(HalfEdge h) {
        const EdgeStar star = mesh_.star(h);
        const Vec3 position(2, 0, 0);
        log_.record(mesh_, star, position);
        mesh_.collapse(star, position);
        kept_ = mesh_.origin(star.ie);
    }
    void move(std::uint32_t v, const Vec3& to) {
        log_.record_move(mesh_, v);
        mesh_.move(v, to);
    }
    [[nodiscard]] std::uint32_t far_away() const {
        std::uint32_t v = mesh_.vertex_count() - 1;
        while (v == kept_ || mesh_.outgoing(v) == kNone) --v;
        return v;
    }

    HalfEdgeMesh mesh_{icosphere(1)};
    CollapseLog log_;
    std::uint32_t kept_ = 0;
};

TEST(CollapseLogTest, OfTwoVerticesWithAsManyEdgesTheFanOfTheNewOneBeginsAtTheNearerEnd) {
    for (const bool at_b : {true, false}) {
        HalfEdgeMesh mesh(icosphere(2));
        HalfEdge h = 0;
        while (mesh.valence(mesh.origin(h)) != mesh.valence(mesh.target(h))) ++h;
        const EdgeStar star = mesh.star(h);
        const std::uint32_t near = mesh.origin(at_b ? star.bj : star.ei);
        const Vec3 position = 0.5 * mesh.position(near) + 0.5 * mesh.position(mesh.origin(h));
        CollapseLog log;
        log.record(mesh, star, position);
        mesh.collapse(star, position);
        const Vec3 end = mesh.position(near);
        const MultiresMesh mrr = log.build(mesh);
        ASSERT_EQ(mrr.levels(), 1U);
        const std::uint32_t anchor = mrr.records.splits()[0].anchor;
        EXPECT_EQ(mrr.base.positions[mrr.base.faces[anchor / 3][(anchor + 1) % 3]], end) << at_b;
    }
}

/// A few steps around two places far from each other, told by one log and by two.
TEST(CollapseLogTest, WhatForksTellIsAsIfOneLogHadBeenTold) {
    const auto step = [](HalfEdgeMesh& mesh, CollapseLog& log, HalfEdge h) {
        const EdgeStar star = mesh.star(h);
        const Vec3 position = (mesh.position(mesh.origin(star.ij)) + mesh.position(mesh.origin(star.ji))) / 2;
        log.record(mesh, star, position);
        mesh.collapse(star, position);
        const HalfEdge beside = next(star.ie);
        log.record_flip(beside);
        mesh.flip(beside);
    };
    const auto move = [](HalfEdgeMesh& mesh, CollapseLog& log, std::uint32_t v) {
        log.record_move(mesh, v);
        mesh.move(v, mesh.position(v) * 1.01);
    };
    for (const bool has_edits_before : {false, true}) {
        HalfEdgeMesh mesh(icosphere(4)), other(icosphere(4));
        CollapseLog log, forked;
        const HalfEdge first = 0, second = mesh.half_edge_count() / 2, third = mesh.half_edge_count() / 4 / 3 * 3;
        if (has_edits_before) {
            step(mesh, log, third);
            step(other, forked, third);
            move(mesh, log, mesh.vertex_count() - 1);
            move(other, forked, mesh.vertex_count() - 1);
        }
        forked.end_step(other);
        CollapseLog left = forked.fork(other), right = forked.fork(other);
        for (const HalfEdge h : {first, first + 300}) step(mesh, log, h);
        for (const HalfEdge h : {second, second + 300}) step(mesh, log, h);
        for (const HalfEdge h : {second, second + 300}) step(other, right, h);  // at the same time as the left ones
        for (const HalfEdge h : {first, first + 300}) step(other, left, h);
        forked.append(std::move(left));
        forked.append(std::move(right));
        EXPECT_EQ(forked.size(), log.size());
        CollapseLog moves = forked.fork(other);
        for (const std::uint32_t v : {mesh.vertex_count() - 1, mesh.vertex_count() - 1, mesh.vertex_count() - 40}) {
            move(mesh, log, v);
            move(other, moves, v);
        }
        forked.append(std::move(moves));
        step(mesh, log, third + 600);
        step(other, forked, third + 600);
        const MultiresMesh expected = log.build(mesh), found = forked.build(other);
        EXPECT_GT(expected.records.moves().size(), 0U);
        EXPECT_GT(expected.records.flips().size(), 4U);
        EXPECT_EQ(found, expected);
    }
}

TEST_F(CollapseLogStepTest, MovesOfAStepAreOne) {
    const std::uint32_t v = far_away();
    const Vec3 lay = mesh_.position(v);
    move(v, Vec3(5, 5, 5));
    move(v, Vec3(6, 6, 6));
    const MultiresMesh mrr = log_.build(mesh_);
    ASSERT_EQ(mrr.records.moves().size(), 1U);
    EXPECT_EQ(mrr.records.moves()[0].position, lay);
    EXPECT_EQ(mrr.base.positions[mrr.records.moves()[0].vertex], Vec3(6, 6, 6));
}

TEST_F(CollapseLogStepTest, MovesInVainAreNone) {
    const std::uint32_t v = far_away();
    const Vec3 lay = mesh_.position(v);
    move(v, Vec3(5, 5, 5));
    move(v, lay);
    EXPECT_EQ(log_.build(mesh_).records.size(), 1U);
}

TEST_F(CollapseLogStepTest, TheSplitMovesItsOwnVertex) {
    move(kept_, Vec3(5, 5, 5));
    const MultiresMesh mrr = log_.build(mesh_);
    ASSERT_EQ(mrr.records.size(), 1U);
    EXPECT_EQ(unnumbered(mesh_at(mrr, 1)), unnumbered(icosphere(1)));
}

TEST_F(CollapseLogStepTest, EachStepHasItsOwnMoves) {
    const std::uint32_t v = far_away();
    move(v, Vec3(5, 5, 5));
    HalfEdge h = 100;
    while (mesh_.removed(h) || mesh_.origin(h) == v || mesh_.target(h) == v) ++h;
    collapse(h);
    move(v, Vec3(6, 6, 6));
    const MultiresMesh mrr = log_.build(mesh_);
    EXPECT_EQ(std::vector(mrr.records.kinds().begin(), mrr.records.kinds().end()),
              (std::vector{RecordKind::kMove, RecordKind::kSplit, RecordKind::kMove, RecordKind::kSplit}));
    EXPECT_EQ(mrr.records.moves()[0].position, Vec3(5, 5, 5));
}

TEST_F(CollapseLogStepTest, WhatCameBeforeTheFirstCollapseIsForgotten) {
    log_.clear();
    log_.record_flip(200);
    log_.record_move(mesh_, 7);
    EXPECT_EQ(log_.size(), 0U);
    const MultiresMesh mrr = log_.build(mesh_);
    EXPECT_TRUE(mrr.records.empty());
    EXPECT_EQ(mrr.faces_min(), mesh_.live_faces());
}

}  // namespace
}  // namespace vsplit::test
