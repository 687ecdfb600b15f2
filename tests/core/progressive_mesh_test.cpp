#include "vsplit/mrr/progressive_mesh.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/core/meshes.h"
#include "tests/core/random.h"
#include "vsplit/mesh/inspect.h"
#include "vsplit/method/improve.h"

namespace vsplit {
namespace {

MultiresMesh make_mrr(const TriangleMesh& mesh, double size_share = 0.05) {
    ImproveOptions options;
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
            if (level == mrr.splits.size()) break;
            ASSERT_TRUE(mesh->refine({&mrr.splits[level], 1}));
        }
        EXPECT_NEAR(surface_area(mesh->mesh()), surface_area(m.mesh), 1e-9 * surface_area(m.mesh))
            << "the finest level is the source";
    }
}

TEST(ProgressiveMeshTest, RefineThenCoarsenIsTheIdentityBetweenAnyLevels) {
    test::Random random(11);
    for (const test::NamedMesh& m : test::small_meshes()) {
        SCOPED_TRACE(m.name);
        const MultiresMesh mrr = make_mrr(m.mesh);
        auto moving = ProgressiveMesh::from_base(mrr.base);
        ASSERT_TRUE(moving);
        const auto levels = static_cast<std::uint32_t>(mrr.splits.size());
        for (int jump = 0; jump < 12; ++jump) {
            const std::size_t to = random.below(levels + 1);
            if (to > moving->level()) {
                const std::size_t from = moving->level();
                ASSERT_TRUE(moving->refine({&mrr.splits[from], to - from}));
            } else {
                moving->coarsen(moving->level() - to);
            }
            ASSERT_EQ(moving->level(), to);
            ASSERT_EQ(moving->mesh(), mesh_at(mrr, to)) << "level " << to;
        }
        moving->coarsen(levels);
        EXPECT_EQ(moving->mesh(), mrr.base);
    }
}

TEST(ProgressiveMeshTest, LevelForFindsTheFinestThatDoesNotExceed) {
    const MultiresMesh mrr = make_mrr(test::torus(20, 12));
    ASSERT_GT(mrr.splits.size(), 10U);
    EXPECT_EQ(mrr.level_for(0), 0U);
    EXPECT_EQ(mrr.level_for(mrr.faces_min()), 0U);
    EXPECT_EQ(mrr.level_for(mrr.faces_min() + 1), 0U);
    EXPECT_EQ(mrr.level_for(mrr.faces_min() + 2), 1U);
    EXPECT_EQ(mrr.level_for(mrr.faces_max()), mrr.splits.size());
    EXPECT_EQ(mrr.level_for(std::numeric_limits<std::uint32_t>::max()), mrr.splits.size());
}

TEST(ProgressiveMeshTest, RefusesSplitsThatDoNotFitAndStaysWhole) {
    auto mesh = ProgressiveMesh::from_base(test::tetrahedron());
    ASSERT_TRUE(mesh);
    const TriangleMesh before = mesh->mesh();
    const auto refused = [&](const VertexSplit& split) {
        const Status status = mesh->refine({&split, 1});
        return !status && status.error().cause == Cause::kCorrupt && mesh->mesh() == before && mesh->level() == 0;
    };
    const VertexSplit good{0, 1, Vec3(0, 0, 0), Vec3(1, 1, 1)};
    VertexSplit bad = good;
    bad.anchor = 12;
    EXPECT_TRUE(refused(bad));
    bad = good;
    bad.steps = 0;
    EXPECT_TRUE(refused(bad));
    bad.steps = 3;
    EXPECT_TRUE(refused(bad));
    bad.steps = std::numeric_limits<std::uint32_t>::max();
    EXPECT_TRUE(refused(bad));
    bad = good;
    bad.added.x() = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(refused(bad));
    EXPECT_TRUE(mesh->refine({&good, 1}));
    EXPECT_EQ(mesh->mesh().face_count(), 6U);
    EXPECT_TRUE(inspect(mesh->mesh()).closed);
}

TEST(ProgressiveMeshTest, KeepsTheGoodSplitsBeforeABadOne) {
    auto mesh = ProgressiveMesh::from_base(test::tetrahedron());
    ASSERT_TRUE(mesh);
    const std::vector<VertexSplit> splits{{0, 2, Vec3(0, 0, 0), Vec3(1, 1, 1)}, {999, 1, Vec3(0, 0, 0), Vec3(1, 1, 1)}};
    const Status status = mesh->refine(splits);
    ASSERT_FALSE(status);
    EXPECT_NE(status.error().message.find("split 1"), std::string::npos) << status.error().message;
    EXPECT_EQ(mesh->level(), 1U);
    EXPECT_TRUE(inspect(mesh->mesh()).closed);
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

}  // namespace
}  // namespace vsplit
