#include "tests/core/meshes.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "tests/core/random.h"

namespace vsplit::test {
namespace {

// Counts by sets, apart from the engine's own inspection, which is tested with these meshes.
struct Counts {
    std::set<std::pair<std::uint32_t, std::uint32_t>> half_edges;
    bool repeated = false;
};

Counts count_half_edges(const TriangleMesh& mesh) {
    Counts counts;
    for (const Triangle& face : mesh.faces) {
        for (std::size_t i = 0; i < 3; ++i) {
            counts.repeated |= !counts.half_edges.insert({face[i], face[(i + 1) % 3]}).second;
        }
    }
    return counts;
}

// Sum of the genus of `components` components.
int genus(const TriangleMesh& mesh, int components) {
    const auto edges = static_cast<int>(count_half_edges(mesh).half_edges.size() / 2);
    const int euler = static_cast<int>(mesh.vertex_count()) - edges + static_cast<int>(mesh.face_count());
    return components - euler / 2;
}

TEST(MeshesTest, AreClosedAndOriented) {
    for (const auto& [name, mesh] : small_meshes()) {
        const Counts counts = count_half_edges(mesh);
        EXPECT_FALSE(counts.repeated) << name;
        for (const auto& [a, b] : counts.half_edges) EXPECT_TRUE(counts.half_edges.contains({b, a})) << name;
        EXPECT_GT(enclosed_volume(mesh), 0) << name;
    }
}

TEST(MeshesTest, HaveTheGenusTheyPromise) {
    EXPECT_EQ(genus(tetrahedron(), 1), 0);
    EXPECT_EQ(genus(cube(), 1), 0);
    EXPECT_EQ(genus(icosphere(2), 1), 0);
    EXPECT_EQ(genus(torus(12, 7), 1), 1);
    EXPECT_EQ(genus(plate_with_holes(2), 1), 2);
    EXPECT_EQ(genus(plate_with_holes(3), 1), 3);
    EXPECT_EQ(genus(cube_frame(), 1), 5);
    EXPECT_EQ(genus(sliver_cylinder(32, 10), 1), 0);
    EXPECT_EQ(genus(joined(cube(), torus(8, 8), Vec3(5, 0, 0)), 2), 1);
}

TEST(MeshesTest, HaveTheSizeTheyPromise) {
    EXPECT_DOUBLE_EQ(enclosed_volume(cube()), 1);
    EXPECT_EQ(icosphere(2).face_count(), 320U);
    EXPECT_EQ(sliver_cylinder(32, 10).face_count(), 124U);
    EXPECT_DOUBLE_EQ(enclosed_volume(cube_frame()), 20);
    EXPECT_DOUBLE_EQ(enclosed_volume(plate_with_holes(2)), 13);
}

TEST(MeshesTest, ShufflingLeavesTheSurfaceAlone) {
    const TriangleMesh mesh = torus(20, 10);
    const TriangleMesh other = shuffled(mesh, 3);
    EXPECT_NE(mesh, other);
    EXPECT_NEAR(surface_area(mesh), surface_area(other), 1e-9);
    EXPECT_NEAR(enclosed_volume(mesh), enclosed_volume(other), 1e-9);
    EXPECT_EQ(genus(other, 1), 1);
}

TEST(MeshesTest, AreTheSameEveryTime) { EXPECT_EQ(bumpy_sphere(3, 0.01, 7), bumpy_sphere(3, 0.01, 7)); }

TEST(RandomTest, StaysInRange) {
    Random random(1);
    for (int i = 0; i < 1000; ++i) {
        EXPECT_LT(random.below(7), 7U);
        const double x = random.uniform(-2, 3);
        EXPECT_TRUE(x >= -2 && x < 3) << x;
    }
}

}  // namespace
}  // namespace vsplit::test
