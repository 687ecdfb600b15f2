#include "vsplit/quality/self_intersections.h"

#include <gtest/gtest.h>

#include "tests/core/meshes.h"

namespace vsplit {
namespace {

std::size_t count_self_intersections(const TriangleMesh& mesh) { return find_self_intersections(mesh)->size(); }

TEST(SelfIntersectionsTest, ThereAreNoneInGoodMeshes) {
    for (const auto& [name, mesh] : test::small_meshes()) EXPECT_EQ(count_self_intersections(mesh), 0) << name;
}

TEST(SelfIntersectionsTest, CountsThePairsWhereOneTriangleCutsAnother) {
    // One upright triangle through the first of two flat ones, clear of the second.
    TriangleMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0},      {0, 1, 0},     {5, 0, 0},    {6, 0, 0},
                      {5, 1, 0}, {0.2, 0.2, -1}, {0.3, 0.2, 1}, {0.2, 0.3, 1}};
    mesh.faces = {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}};
    ASSERT_EQ(count_self_intersections(mesh), 1);
    EXPECT_EQ((*find_self_intersections(mesh))[0], (std::array<std::uint32_t, 2>{0, 2}));
    mesh.faces = {{0, 1, 2}, {3, 4, 5}, {0, 7, 8}};
    EXPECT_EQ(count_self_intersections(mesh), 0) << "a common vertex is no intersection";
}

TEST(SelfIntersectionsTest, TouchingIsNone) {
    const TriangleMesh stacked = test::joined(test::cube(), test::cube(), Vec3(0.25, 0.25, 1));
    EXPECT_EQ(count_self_intersections(stacked), 0);
}

TEST(SelfIntersectionsTest, FindsTwoCrossingSpheresInAnyOrder) {
    const TriangleMesh crossing = test::joined(test::icosphere(2), test::icosphere(2), Vec3(0.7, 0.3, 0.2));
    const std::size_t found = count_self_intersections(crossing);
    EXPECT_GT(found, 20);
    EXPECT_EQ(count_self_intersections(test::shuffled(crossing, 7)), found);
    EXPECT_EQ(count_self_intersections(test::joined(test::icosphere(2), test::icosphere(2), Vec3(3, 0, 0))), 0);
}

}  // namespace
}  // namespace vsplit
