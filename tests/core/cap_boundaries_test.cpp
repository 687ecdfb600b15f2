#include "mesh/cap_boundaries.h"

#include <gtest/gtest.h>

#include "tests/core/meshes.h"
#include "vsplit/mesh/inspect.h"

namespace vsplit::test {
namespace {

TEST(CapBoundariesTest, ClosesEveryLoopByAGhost) {
    const TriangleMesh mesh = square(3);
    const Expected<CappedMesh> capped = cap_boundaries(mesh);
    ASSERT_TRUE(capped) << capped.error().message;
    EXPECT_EQ(capped->ghosts, 1U);
    EXPECT_EQ(capped->mesh.vertex_count(), 17U);
    EXPECT_EQ(capped->mesh.face_count(), 18U + 12U);
    EXPECT_EQ(capped->mesh.positions[0], Vec3(1.5, 1.5, 0));
    const MeshReport report = inspect(capped->mesh);
    EXPECT_TRUE(report.closed);
    EXPECT_EQ(report.genus, 0);
    for (std::uint32_t f = 0; f < capped->mesh.face_count(); ++f)
        EXPECT_EQ(touches_ghost(capped->mesh.faces[f], 1), f >= 18) << "ghost faces come last";
}

TEST(CapBoundariesTest, VisibleMeshUndoesIt) {
    for (const TriangleMesh& mesh : {square(1), square(7), punctured(torus(16, 10), {0, 35, 70, 105}), icosphere(1),
                                     joined(square(2), icosphere(0), Vec3(9, 9, 9))}) {
        const Expected<CappedMesh> capped = cap_boundaries(mesh);
        ASSERT_TRUE(capped) << capped.error().message;
        EXPECT_TRUE(inspect(capped->mesh).closed);
        EXPECT_EQ(visible_mesh(capped->mesh, capped->ghosts), mesh);
    }
    EXPECT_EQ(cap_boundaries(punctured(torus(16, 10), {0, 35, 70, 105}))->ghosts, 4U);
    EXPECT_EQ(cap_boundaries(icosphere(1))->mesh, icosphere(1));
}

TEST(CapBoundariesTest, RefusesWhatIsNoManifold) {
    EXPECT_EQ(cap_boundaries({}).error().cause, Cause::kEmptyInput);
    TriangleMesh touching = square(2);  // two opposite corners left out: the centre joins two fans
    touching.faces = {{0, 1, 4}, {0, 4, 3}, {4, 5, 8}, {4, 8, 7}};
    const Expected<CappedMesh> touched = cap_boundaries(touching);
    ASSERT_FALSE(touched);
    EXPECT_EQ(touched.error().cause, Cause::kNonManifold);
    EXPECT_NE(touched.error().message.find("touches itself at vertex 4;"), std::string::npos) << touched.error().message;
    TriangleMesh turned = square(1);
    std::swap(turned.faces[0][0], turned.faces[0][1]);
    EXPECT_EQ(cap_boundaries(turned).error().cause, Cause::kNonManifold);
    TriangleMesh three = square(1);
    three.positions.emplace_back(0, 0, 1);
    three.faces.push_back({0, 3, 4});
    EXPECT_EQ(cap_boundaries(three).error().cause, Cause::kNonManifold);
}

}  // namespace
}  // namespace vsplit::test
