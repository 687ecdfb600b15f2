#include "vsplit/mesh/weld.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "tests/core/meshes.h"
#include "tests/core/random.h"

namespace vsplit::test {
namespace {

/// Every face with vertices of its own, as STL has them.
TriangleMesh soup(const TriangleMesh& mesh) {
    TriangleMesh result;
    for (const Triangle& face : mesh.faces) {
        const std::uint32_t first = result.vertex_count();
        for (const std::uint32_t vertex : face) result.positions.push_back(mesh.positions[vertex]);
        result.faces.push_back({first, first + 1, first + 2});
    }
    return result;
}

/// What `weld` is said to do, straight from the sentence that says it.
TriangleMesh weld_slowly(const TriangleMesh& mesh, double tolerance) {
    std::vector<Vec3> kept;
    std::vector<std::uint32_t> number;
    for (const Vec3& position : mesh.positions) {
        std::uint32_t found = 0;
        while (found < kept.size() && (kept[found] - position).norm() > tolerance) ++found;
        if (found == kept.size()) kept.push_back(position);
        number.push_back(found);
    }
    TriangleMesh result;
    std::vector<std::uint32_t> used(kept.size(), 0);
    for (const auto& [a, b, c] : mesh.faces) {
        const Triangle face = {number[a], number[b], number[c]};
        if (face[0] == face[1] || face[1] == face[2] || face[2] == face[0]) continue;
        result.faces.push_back(face);
        for (const std::uint32_t vertex : face) used[vertex] = 1;
    }
    for (std::size_t vertex = 0; vertex < kept.size(); ++vertex) {
        if (used[vertex] == 0) continue;
        used[vertex] = result.vertex_count();
        result.positions.push_back(kept[vertex]);
    }
    for (Triangle& face : result.faces) {
        for (std::uint32_t& vertex : face) vertex = used[vertex];
    }
    return result;
}

TEST(WeldTest, SoupBecomesTheMeshItCameFrom) {
    for (const auto& [name, mesh] : small_meshes()) {
        TriangleMesh welded = soup(mesh);
        const Expected<WeldCounts> counts = weld(welded, 0);
        ASSERT_TRUE(counts) << name;
        EXPECT_EQ(welded.vertex_count(), mesh.vertex_count()) << name;
        EXPECT_EQ(welded.face_count(), mesh.face_count()) << name;
        EXPECT_EQ(counts->merged_vertices, 3 * mesh.face_count() - mesh.vertex_count()) << name;
        EXPECT_EQ(counts->unused_vertices, 0U) << name;
        EXPECT_EQ(counts->collapsed_faces, 0U) << name;
        EXPECT_EQ(soup(welded), soup(mesh)) << name;
        EXPECT_EQ(welded, weld_slowly(soup(mesh), 0)) << name;
    }
}

TEST(WeldTest, WeldedMeshStaysAsItIs) {
    TriangleMesh mesh = shuffled(torus(24, 12), 5);
    const TriangleMesh before = mesh;
    const Expected<WeldCounts> counts = weld(mesh, 0);
    ASSERT_TRUE(counts);
    EXPECT_EQ(mesh, before);
    EXPECT_EQ(counts->merged_vertices, 0U);
}

TEST(WeldTest, NegativeZeroEqualsZero) {
    TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.0, -0.0, -0.0}, {0, 0, 1}}, {{0, 1, 2}, {3, 4, 1}}};
    const Expected<WeldCounts> counts = weld(mesh, 0);
    ASSERT_TRUE(counts);
    EXPECT_EQ(counts->merged_vertices, 1U);
    EXPECT_EQ(mesh.faces[1], (Triangle{0, 3, 1}));
}

TEST(WeldTest, NextDoubleIsAnotherVertex) {
    const double above = std::nextafter(1.0, 2.0);
    TriangleMesh mesh{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {above, 0, 0}}, {{0, 1, 2}, {3, 2, 1}}};
    ASSERT_TRUE(weld(mesh, 0));
    EXPECT_EQ(mesh.vertex_count(), 4U);
    ASSERT_TRUE(weld(mesh, above - 1));
    EXPECT_EQ(mesh.vertex_count(), 3U);
}

TEST(WeldTest, CountsWhatItDrops) {
    // Vertex 3 is used by the collapsed face only, vertex 4 by none.
    TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, 5}, {7, 7, 7}, {1, 0, 0}}, {{1, 5, 3}, {0, 5, 2}}};
    const Expected<WeldCounts> counts = weld(mesh, 0);
    ASSERT_TRUE(counts);
    EXPECT_EQ(counts->merged_vertices, 1U);
    EXPECT_EQ(counts->collapsed_faces, 1U);
    EXPECT_EQ(counts->unused_vertices, 2U);
    EXPECT_EQ(mesh, (TriangleMesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}));
}

TEST(WeldTest, ToleranceAgreesWithComparingAllPairs) {
    Random random(7);
    for (int round = 0; round < 200; ++round) {
        // Magnitudes far apart, so that the grid is tried with few and with many points a cell, near and far from the origin.
        const double spread = std::pow(10.0, random.uniform(-3, 3));
        const double offset = random.below(2) == 0 ? 0 : std::pow(10.0, random.uniform(0, 6));
        const double tolerance = spread * std::pow(10.0, random.uniform(-2, 0.5));
        TriangleMesh mesh;
        for (int i = 0; i < 60; ++i) {
            const auto coordinate = [&] { return offset + random.uniform(-spread, spread); };
            mesh.positions.emplace_back(coordinate(), coordinate(), coordinate());
        }
        for (int i = 0; i < 100; ++i) mesh.faces.push_back({random.below(60), random.below(60), random.below(60)});
        const TriangleMesh expected = weld_slowly(mesh, tolerance);
        ASSERT_TRUE(weld(mesh, tolerance));
        EXPECT_EQ(mesh, expected) << "round " << round << ", tolerance " << tolerance;
    }
}

TEST(WeldTest, ToleranceOnAGridOfThatSpacing) {
    TriangleMesh mesh;
    for (int i = 0; i < 1000; ++i) mesh.positions.emplace_back(i % 10, i / 10 % 10, i / 100);  // exactly 1 apart
    for (std::uint32_t i = 0; i + 2 < 1000; ++i) mesh.faces.push_back({i, i + 1, i + 2});
    const TriangleMesh expected = weld_slowly(mesh, 1);
    ASSERT_TRUE(weld(mesh, 1));
    EXPECT_EQ(mesh, expected);
    EXPECT_LT(mesh.vertex_count(), 1000U);
}

TEST(WeldTest, ExtremeTolerancesAreSafe) {
    constexpr double kLargest = std::numeric_limits<double>::max();
    TriangleMesh point = soup(icosphere(2));
    ASSERT_TRUE(weld(point, kLargest));
    EXPECT_TRUE(point.faces.empty());
    EXPECT_TRUE(point.positions.empty());

    TriangleMesh far = cube();
    for (Vec3& position : far.positions) position *= 1e15;
    const TriangleMesh before = far;
    ASSERT_TRUE(weld(far, std::numeric_limits<double>::denorm_min()));
    EXPECT_EQ(far, before);
}

TEST(WeldTest, CloudOfClosePointsIsNotQuadratic) {
    Random random(11);
    TriangleMesh mesh;
    for (int i = 0; i < 300'000; ++i)
        mesh.positions.emplace_back(random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1));
    for (std::uint32_t i = 0; i + 2 < 300'000; i += 3) mesh.faces.push_back({i, i + 1, i + 2});
    ASSERT_TRUE(weld(mesh, 0.05));  // ctest's limit on time is the check
    EXPECT_LT(mesh.vertex_count(), 30'000U);
    for (std::size_t i = 1; i < mesh.positions.size(); ++i) ASSERT_GT((mesh.positions[i] - mesh.positions[i - 1]).norm(), 0.05);
}

TEST(WeldTest, RefusesToleranceThatIsNoLength) {
    for (const double tolerance : {-1.0, -1e-300, std::nan(""), std::numeric_limits<double>::infinity()}) {
        TriangleMesh mesh = cube();
        const Expected<WeldCounts> counts = weld(mesh, tolerance);
        ASSERT_FALSE(counts);
        EXPECT_EQ(counts.error().cause, Cause::kInvalidOption);
        EXPECT_EQ(counts.error().field, "weld");
        EXPECT_EQ(mesh, cube());
    }
}

TEST(WeldTest, EmptyMeshStaysEmpty) {
    TriangleMesh mesh;
    ASSERT_TRUE(weld(mesh, 0));
    ASSERT_TRUE(weld(mesh, 1));
    EXPECT_EQ(mesh, TriangleMesh());
}

}  // namespace
}  // namespace vsplit::test
