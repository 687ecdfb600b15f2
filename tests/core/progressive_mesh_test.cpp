#include "vsplit/mrr/progressive_mesh.h"

#include <gtest/gtest.h>

#include <limits>
#include <optional>

#include "mesh/cap_boundaries.h"
#include "mesh/half_edges.h"
#include "tests/core/edited_mrr.h"
#include "tests/core/meshes.h"
#include "tests/core/random.h"
#include "vsplit/mesh/inspect.h"
#include "vsplit/method/improve.h"

namespace vsplit {
namespace {

MultiresMesh make_mrr(const TriangleMesh& mesh, double size_share = 0.05) {
    ImproveOptions options;
    options.mode = Mode::kStrict;  // splits alone: a level a record, and the finest is the source
    options.subdivision_size = size_share * bounding_box(mesh).diagonal();
    options.tolerance = 0.05 * bounding_box(mesh).diagonal();
    const ExecutionContext context;
    Expected<MethodResult> result = improve(mesh, options, {}, context);
    EXPECT_TRUE(result) << result.error().message;
    return std::move(result->mrr);
}

TEST(ProgressiveMeshTest, EveryLevelIsAClosedManifoldOfTheSameGenus) {
    for (const test::NamedMesh& m : test::small_meshes()) {
        SCOPED_TRACE(m.name);
        const MeshReport source = inspect(m.mesh);
        const MultiresMesh mrr = make_mrr(m.mesh, 0.2);
        auto mesh = ProgressiveMesh::from_base(mrr.base);
        ASSERT_TRUE(mesh) << mesh.error().message;
        for (std::size_t level = 0;; ++level) {
            const MeshReport report = inspect(mesh->mesh());
            ASSERT_TRUE(report.closed) << "level " << level;
            ASSERT_EQ(report.genus, source.genus) << "level " << level;
            ASSERT_EQ(report.components, source.components) << "level " << level;
            ASSERT_EQ(report.faces, mrr.faces_at(level));
            if (level == mrr.levels()) break;
            ASSERT_TRUE(mesh->refine(mrr.records.slice(level, 1)));
        }
        EXPECT_NEAR(surface_area(mesh->mesh()), surface_area(m.mesh), 1e-9 * surface_area(m.mesh))
            << "the finest level is the source";
    }
}

TEST(ProgressiveMeshTest, SplitsWhoseCornersAreKnownMakeTheSameMesh) {
    for (const test::NamedMesh& m : test::small_meshes()) {
        SCOPED_TRACE(m.name);
        const MultiresMesh mrr = make_mrr(m.mesh, 0.2);
        auto walked = ProgressiveMesh::from_base(mrr.base, mrr.ghosts);
        auto known = ProgressiveMesh::from_base(mrr.base, mrr.ghosts);
        ASSERT_TRUE(walked && known);
        for (const VertexSplit& split : mrr.records.splits()) {
            std::vector<HalfEdge> corners{split.anchor};
            while (corners.size() <= split.steps) corners.push_back(known->twins()[prev(corners.back())]);
            ASSERT_TRUE(walked->refine(split));
            ASSERT_TRUE(known->refine(split, corners.data()));
        }
        EXPECT_TRUE(walked->mesh() == known->mesh());
        EXPECT_EQ(walked->twins(), known->twins());
        EXPECT_EQ(walked->border_splits(), known->border_splits());
    }
}

TEST(ProgressiveMeshTest, ASplitAtAGhostIsRefusedWhereItsCornersAreKnown) {
    const TriangleMesh octahedron{{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
                                  {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
    auto mesh = ProgressiveMesh::from_base(octahedron, 1);
    ASSERT_TRUE(mesh);
    const VertexSplit split{0, 1, {1, 0, 0}, {1, 0.1, 0}};
    const std::vector<HalfEdge> corners{0, mesh->twins()[prev(0)]};
    const Status refused = mesh->refine(split, corners.data());
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().message, "record 0, vertex split: at vertex 0, a ghost");
    EXPECT_TRUE(mesh->mesh() == octahedron);
}

/// Moves between levels at random, each time in runs that break anywhere.
void expect_identity_between_levels(const MultiresMesh& mrr, std::uint64_t seed) {
    test::Random random(seed);
    auto moving = ProgressiveMesh::from_base(mrr.base, mrr.ghosts);
    ASSERT_TRUE(moving);
    const auto levels = static_cast<std::uint32_t>(mrr.levels());
    for (int jump = 0; jump < 12; ++jump) {
        const std::size_t to = random.below(levels + 1);
        const std::size_t last = mrr.record_of_level(to);
        if (to < moving->level()) moving->coarsen(moving->level() - to);
        while (moving->records() < last) {
            const std::size_t count = 1 + random.below(static_cast<std::uint32_t>(last - moving->records()));
            const Status refined = moving->refine(mrr.records.slice(moving->records(), count));
            ASSERT_TRUE(refined) << refined.error().message;
        }
        ASSERT_EQ(moving->level(), to);
        ASSERT_EQ(moving->records(), last);
        ASSERT_EQ(moving->visible(), mesh_at(mrr, to)) << "level " << to;
        ASSERT_EQ(moving->visible().face_count(), mrr.faces_at(to));
    }
    moving->coarsen(levels);
    EXPECT_EQ(moving->mesh(), mrr.base);
    EXPECT_EQ(moving->records(), 0U);
}

TEST(ProgressiveMeshTest, RefineThenCoarsenIsTheIdentityBetweenAnyLevels) {
    for (const test::NamedMesh& m : test::small_meshes()) {
        SCOPED_TRACE(m.name);
        expect_identity_between_levels(make_mrr(m.mesh), 11);
        const MultiresMesh edited = test::edited_mrr(m.mesh, 300, 12).mrr;
        EXPECT_EQ(edited.levels() == 0, edited.records.empty());
        expect_identity_between_levels(edited, 13);
    }
    for (const TriangleMesh& open : {test::square(12), test::punctured(test::torus(24, 12), {0, 40, 80})}) {
        const MultiresMesh edited = test::edited_mrr(open, 200, 14).mrr;
        EXPECT_FALSE(edited.border_splits.empty());
        expect_identity_between_levels(edited, 15);
    }
}

TEST(ProgressiveMeshTest, EveryRecordIsUndoneByteForByte) {
    const MultiresMesh mrr = test::edited_mrr(test::punctured(test::torus(12, 8), {0, 44}), 60, 2).mrr;
    auto mesh = ProgressiveMesh::from_base(mrr.base, mrr.ghosts);
    ASSERT_TRUE(mesh);
    std::vector<TriangleMesh> states;
    for (std::size_t n = 0; n < mrr.records.size(); ++n) {
        states.push_back(mesh->mesh());
        ASSERT_TRUE(mesh->refine(mrr.records.slice(n, 1)));
        ASSERT_TRUE(inspect(mesh->mesh()).closed);
    }
    for (std::size_t n = mrr.records.size(); n-- > 0;) {
        ASSERT_EQ(mesh->last(), mrr.records[n]) << "what is undone can be had back";
        mesh->rewind(n);
        ASSERT_EQ(mesh->records(), n);
        ASSERT_EQ(mesh->mesh(), states[n]);
    }
}

TEST(ProgressiveMeshTest, RoomForForeseenSplitsIsMadeOnceAndNeverForAnyNumber) {
    const MultiresMesh mrr = make_mrr(test::torus(20, 12), 0.2);
    auto mesh = ProgressiveMesh::from_base(mrr.base, mrr.ghosts);
    ASSERT_TRUE(mesh);
    ASSERT_GT(mrr.levels(), mrr.base.positions.size()) << "it would not have to grow";
    ASSERT_LE(mrr.levels(), ProgressiveMesh::kMostForeseen * mrr.base.positions.size());
    mesh->foresee(mrr.levels());
    const Vec3* const positions = mesh->mesh().positions.data();
    const Triangle* const faces = mesh->mesh().faces.data();
    ASSERT_TRUE(mesh->refine(mrr.records.slice(0, 10)));
    ASSERT_TRUE(mesh->refine(mrr.records.slice(10, mrr.records.size() - 10)));
    EXPECT_EQ(mesh->mesh().positions.data(), positions);
    EXPECT_EQ(mesh->mesh().faces.data(), faces);
    EXPECT_EQ(mesh->visible(), mesh_at(mrr, mrr.levels()));

    auto claimed = ProgressiveMesh::from_base(mrr.base, mrr.ghosts);
    ASSERT_TRUE(claimed);
    claimed->foresee(std::numeric_limits<std::uint32_t>::max());
    EXPECT_LE(claimed->mesh().positions.capacity(), (ProgressiveMesh::kMostForeseen + 1) * mrr.base.positions.size());
}

TEST(ProgressiveMeshTest, CoarsenUndoesTheEditsOfAStepBegun) {
    auto mesh = ProgressiveMesh::from_base(test::tetrahedron());
    ASSERT_TRUE(mesh);
    ASSERT_TRUE(mesh->refine(RecordList{VertexSplit{0, 1, Vec3(0, 0, 0), Vec3(1, 1, 1)}}));
    const TriangleMesh level = mesh->mesh();
    ASSERT_TRUE(mesh->refine(RecordList{VertexMove{1, Vec3(3, 3, 3)}, VertexMove{2, Vec3(4, 4, 4)}}));
    mesh->coarsen(0);
    EXPECT_EQ(mesh->mesh(), level);
    EXPECT_EQ(mesh->level(), 1U);
    ASSERT_TRUE(mesh->refine(RecordList{VertexMove{1, Vec3(3, 3, 3)}}));
    mesh->coarsen(1);
    EXPECT_EQ(mesh->mesh(), test::tetrahedron());
    ASSERT_TRUE(mesh->refine(RecordList{VertexMove{1, Vec3(3, 3, 3)}}));
    mesh->coarsen(5);
    EXPECT_EQ(mesh->mesh(), test::tetrahedron());
}

TEST(ProgressiveMeshTest, LevelForFindsTheFinestThatDoesNotExceed) {
    const MultiresMesh mrr = make_mrr(test::torus(20, 12));
    ASSERT_GT(mrr.levels(), 10U);
    EXPECT_EQ(mrr.level_for(0), 0U);
    EXPECT_EQ(mrr.level_for(mrr.faces_min()), 0U);
    EXPECT_EQ(mrr.level_for(mrr.faces_min() + 1), 0U);
    EXPECT_EQ(mrr.level_for(mrr.faces_min() + 2), 1U);
    EXPECT_EQ(mrr.level_for(mrr.faces_max()), mrr.levels());
    EXPECT_EQ(mrr.level_for(std::numeric_limits<std::uint32_t>::max()), mrr.levels());
}

/// A mesh that must refuse a record and stay as it is.
class RefusalTest : public ::testing::Test {
protected:
    /// Whether the record is refused, with a message that has `what` in it.
    testing::AssertionResult refused(const Record& record, const std::string& what) {
        const TriangleMesh before = mesh_->mesh();
        const std::size_t records = mesh_->records();
        const Status status = mesh_->refine(RecordList{record});
        if (status) return testing::AssertionFailure() << "it was accepted";
        if (status.error().cause != Cause::kCorrupt || status.error().message.find(what) == std::string::npos ||
            status.error().message.find("record " + std::to_string(records) + ", ") != 0) {
            return testing::AssertionFailure() << status.error().message;
        }
        if (mesh_->mesh() != before || mesh_->records() != records) return testing::AssertionFailure() << "the mesh changed";
        return testing::AssertionSuccess();
    }
    void begin(const TriangleMesh& base, std::uint32_t ghosts = 0) {
        auto mesh = ProgressiveMesh::from_base(base, ghosts);
        ASSERT_TRUE(mesh) << mesh.error().message;
        mesh_ = *std::move(mesh);
    }

    std::optional<ProgressiveMesh> mesh_;
    const Vec3 bad_{0, std::numeric_limits<double>::quiet_NaN(), 0};
    const Vec3 far_{2e15, 0, 0};
};

/// An icosahedron whose face 0 = (a, c, d) is cut in three at b, and of these (b, c, d) at e: half-edge 0 is a -> b, whose ends
/// have valences over 3 and whose faces' other corners, c and d, have an edge already.
TriangleMesh twice_cut() {
    TriangleMesh mesh = test::icosphere(0);
    const auto [a, c, d] = mesh.faces[0];
    const std::uint32_t b = mesh.vertex_count(), e = b + 1;
    mesh.positions.emplace_back(0.1, 0, 0);
    mesh.positions.emplace_back(0.2, 0, 0);
    mesh.faces[0] = {a, b, d};
    for (const Triangle& face : {Triangle{b, a, c}, Triangle{b, c, e}, Triangle{c, d, e}, Triangle{d, b, e}})
        mesh.faces.push_back(face);
    return mesh;
}

TEST_F(RefusalTest, SplitsThatDoNotFit) {
    begin(test::tetrahedron());
    const Vec3 here(0, 0, 0), there(1, 1, 1);
    EXPECT_TRUE(refused(VertexSplit{12, 1, here, there}, "anchor 12 is no corner"));
    EXPECT_TRUE(refused(VertexSplit{0, 0, here, there}, "0 steps"));
    EXPECT_TRUE(refused(VertexSplit{0, 3, here, there}, "valence 3"));
    EXPECT_TRUE(refused(VertexSplit{0, std::numeric_limits<std::uint32_t>::max(), here, there}, "valence 3"));
    EXPECT_TRUE(refused(VertexSplit{0, 1, here, bad_}, "coordinate"));
    EXPECT_TRUE(refused(VertexSplit{0, 1, far_, there}, "coordinate"));
    EXPECT_TRUE(mesh_->refine(RecordList{VertexSplit{0, 1, here, there}}));
    EXPECT_EQ(mesh_->mesh().face_count(), 6U);
    EXPECT_TRUE(inspect(mesh_->mesh()).closed);
}

TEST_F(RefusalTest, FlipsThatDoNotFit) {
    begin(test::tetrahedron());
    EXPECT_TRUE(refused(EdgeFlip{12}, "12 is no half-edge"));
    EXPECT_TRUE(refused(EdgeFlip{0}, "valence under 4"));
    begin(twice_cut());
    EXPECT_TRUE(refused(EdgeFlip{0}, "which have an edge already"));
}

TEST_F(RefusalTest, FlipsAreAcceptedExactlyWhereTheyAreLegal) {
    const TriangleMesh base = twice_cut();
    const test::RandomEditor editor(base, 0, 0);
    int legal = 0, illegal = 0;
    for (std::uint32_t h = 0; h < base.face_count() * 3; ++h) {
        begin(base);
        const bool accepted = static_cast<bool>(mesh_->refine(RecordList{EdgeFlip{h}}));
        ASSERT_EQ(accepted, editor.may_flip(h)) << h;
        EXPECT_TRUE(inspect(mesh_->mesh()).closed);
        ++(accepted ? legal : illegal);
    }
    EXPECT_GT(legal, 0);
    EXPECT_GT(illegal, 0);
}

TEST_F(RefusalTest, MovesThatDoNotFit) {
    begin(test::tetrahedron());
    EXPECT_TRUE(refused(VertexMove{4, Vec3(0, 0, 0)}, "4 is no vertex"));
    EXPECT_TRUE(refused(VertexMove{0, bad_}, "coordinate"));
    EXPECT_TRUE(refused(VertexMove{0, far_}, "coordinate"));
}

TEST_F(RefusalTest, WhatTouchesAGhost) {
    const Expected<CappedMesh> capped = cap_boundaries(test::square(3));
    ASSERT_TRUE(capped);
    begin(capped->mesh, capped->ghosts);
    EXPECT_EQ(mesh_->visible(), test::square(3));
    EXPECT_TRUE(refused(VertexMove{0, Vec3(0, 0, 0)}, "of vertex 0, a ghost"));
    EXPECT_TRUE(mesh_->refine(RecordList{VertexMove{1, Vec3(0.1, 0, 0)}}));
    mesh_->rewind(0);
    for (std::uint32_t h = 0; h < capped->mesh.face_count() * 3; ++h) {
        const bool at_ghost = origin(capped->mesh, h) == 0;
        if (at_ghost) {
            EXPECT_TRUE(refused(VertexSplit{h, 1, Vec3(0, 0, 0), Vec3(1, 1, 1)}, "at vertex 0, a ghost"));
        }
        if (touches_ghost(capped->mesh.faces[face_of(h)], 1)) {
            EXPECT_TRUE(refused(EdgeFlip{h}, "beside vertex 0, a ghost"));
        }
    }
}

TEST_F(RefusalTest, SplitsBetweenTwoGhosts) {
    // An octahedron whose poles are ghosts, so that vertex 2 lies between them, with one face beside the lower one raised.
    const TriangleMesh octahedron{
        {{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 5}},
        {{0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 2}, {1, 3, 2}, {1, 4, 3}, {1, 2, 5}, {6, 5, 4}, {1, 6, 4}, {1, 5, 6}}};
    begin(octahedron, 2);
    const Vec3 here(1, 0, 0), there(1, 0.1, 0);
    bool between = false;
    for (std::uint32_t corner = 0; corner < octahedron.face_count() * 3; ++corner) {
        if (origin(octahedron, corner) != 2 || origin(octahedron, next(corner)) > 1) continue;
        between = true;
        EXPECT_TRUE(refused(VertexSplit{corner, 2, here, there}, "between two ghosts"));
        EXPECT_TRUE(mesh_->refine(RecordList{VertexSplit{corner, 1, here, there}}));
        EXPECT_EQ(mesh_->border_splits(), std::vector<std::uint32_t>{0});
        mesh_->rewind(0);
        EXPECT_TRUE(mesh_->border_splits().empty());
    }
    EXPECT_TRUE(between);
}

TEST(ProgressiveMeshTest, KeepsTheGoodRecordsBeforeABadOne) {
    auto mesh = ProgressiveMesh::from_base(test::tetrahedron());
    ASSERT_TRUE(mesh);
    const RecordList records{VertexSplit{0, 2, Vec3(0, 0, 0), Vec3(1, 1, 1)}, VertexMove{0, Vec3(0, 0, 1)},
                             VertexSplit{999, 1, Vec3(0, 0, 0), Vec3(1, 1, 1)}};
    const Status status = mesh->refine(records);
    ASSERT_FALSE(status);
    EXPECT_NE(status.error().message.find("record 2, vertex split"), std::string::npos) << status.error().message;
    EXPECT_EQ(mesh->level(), 1U);
    EXPECT_EQ(mesh->records(), 2U);
    EXPECT_TRUE(inspect(mesh->mesh()).closed);
}

TEST(ProgressiveMeshTest, RefusesGhostsThatCannotBe) {
    EXPECT_EQ(ProgressiveMesh::from_base(test::tetrahedron(), 5).error().cause, Cause::kCorrupt);
    EXPECT_EQ(ProgressiveMesh::from_base(test::tetrahedron(), 2).error().cause, Cause::kCorrupt);
    EXPECT_TRUE(ProgressiveMesh::from_base(test::tetrahedron(), 1));
    TriangleMesh cones;  // two ghosts over a triangle: no face is left
    cones.positions = {{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {-1, 1, 0}, {-1, -1, 0}};
    cones.faces = {{2, 3, 0}, {3, 4, 0}, {4, 2, 0}, {3, 2, 1}, {4, 3, 1}, {2, 4, 1}};
    EXPECT_EQ(ProgressiveMesh::from_base(cones, 2).error().cause, Cause::kEmptyInput);
    EXPECT_EQ(ProgressiveMesh::from_base(cones, 1)->visible().face_count(), 3U);
}

TEST(ProgressiveMeshTest, RefusesBasesThatAreNoClosedManifold) {
    TriangleMesh open = test::cube();
    open.faces.pop_back();
    EXPECT_EQ(ProgressiveMesh::from_base(open).error().cause, Cause::kOpenMesh);
    TriangleMesh wrong = test::cube();
    wrong.faces[2][1] = 99;
    EXPECT_EQ(ProgressiveMesh::from_base(wrong).error().cause, Cause::kIndexOutOfRange);
    TriangleMesh infinite = test::cube();
    infinite.positions[2].y() = std::numeric_limits<double>::infinity();
    EXPECT_EQ(ProgressiveMesh::from_base(infinite).error().cause, Cause::kInvalidCoordinate);
    EXPECT_EQ(ProgressiveMesh::from_base({}).error().cause, Cause::kEmptyInput);
}

TEST(ProgressiveMeshTest, KnowsACornerOfEveryVertexWhereverItStands) {
    using namespace test;
    const MultiresMesh mrr = edited_mrr(punctured(torus(16, 10), {0, 35, 70, 105}), 150, 7).mrr;
    ProgressiveMesh mesh = *ProgressiveMesh::from_base(mrr.base, mrr.ghosts);
    Random random(5);
    for (int step = 0; step < 300; ++step) {
        const std::uint32_t to = random.below(static_cast<std::uint32_t>(mrr.records.size()) + 1);
        if (to < mesh.records()) {
            mesh.rewind(to);
        } else {
            ASSERT_TRUE(mesh.refine(mrr.records.slice(mesh.records(), to - mesh.records())));
        }
        for (std::uint32_t v = 0; v < mesh.mesh().vertex_count(); ++v) {
            const std::uint32_t corner = mesh.corner_of(v);
            ASSERT_LT(corner, 3 * mesh.mesh().face_count()) << "vertex " << v;
            ASSERT_EQ(mesh.mesh().faces[corner / 3][corner % 3], v);
        }
    }
}

}  // namespace
}  // namespace vsplit
