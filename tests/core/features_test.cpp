#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "tests/core/meshes.h"
#include "vsplit/features/face_normals.h"
#include "vsplit/features/sharp_edges.h"

namespace vsplit {
namespace {

TEST(FaceNormalsTest, PointOutwards) {
    const TriangleMesh mesh = test::icosphere(2);
    const FaceNormals normals = face_normals(mesh);
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        EXPECT_TRUE(normals.reliable[f]);
        EXPECT_NEAR(normals.normals[f].norm(), 1, 1e-12);
        EXPECT_GT(normals.normals[f].dot(mesh.positions[mesh.faces[f][0]]), 0.5);
    }
}

TEST(FaceNormalsTest, ASliverBorrowsFromAcrossItsLongestEdge) {
    // A tetrahedron with a fourth corner on an edge of its base: the face over that edge has no area.
    TriangleMesh mesh = test::tetrahedron();
    const Triangle split = mesh.faces[0];
    const auto middle = mesh.vertex_count();
    mesh.positions.push_back((mesh.positions[split[0]] + mesh.positions[split[1]]) / 2);
    mesh.faces[0] = {split[0], middle, split[2]};
    mesh.faces.push_back({middle, split[1], split[2]});
    mesh.faces.push_back({split[0], split[1], middle});  // the sliver, between the cut face and the face beyond the edge
    const FaceNormals normals = face_normals(mesh);
    const auto sliver = mesh.face_count() - 1;
    EXPECT_FALSE(normals.reliable[sliver]);
    std::uint32_t beyond = 0;
    for (std::uint32_t f = 1; f < 4; ++f) {
        const Triangle& t = mesh.faces[f];
        for (int c = 0; c < 3; ++c) {
            if (t[c] == split[1] && t[(c + 1) % 3] == split[0]) beyond = f;
        }
    }
    ASSERT_NE(beyond, 0U);
    EXPECT_EQ(normals.normals[sliver], normals.normals[beyond]);
}

TEST(FaceNormalsTest, AComponentWithoutAreaKeepsNone) {
    TriangleMesh mesh = test::tetrahedron();
    for (Vec3& p : mesh.positions) p = Vec3(p.x(), 0, 0);
    const FaceNormals normals = face_normals(mesh);
    for (const bool reliable : normals.reliable) EXPECT_FALSE(reliable);
}

TEST(SharpEdgesTest, FindsTheTwelveEdgesOfACube) {
    const TriangleMesh mesh = test::cube();
    const std::vector<SharpEdge> edges = find_sharp_edges(mesh, face_normals(mesh), {40, 10});
    ASSERT_EQ(edges.size(), 12U);
    for (const SharpEdge& edge : edges) {
        EXPECT_NEAR((mesh.positions[edge.a] - mesh.positions[edge.b]).norm(), 1, 1e-12);
        EXPECT_NEAR(edge.weight, 10, 1e-9) << "a right angle weighs what was asked";
    }
}

TEST(SharpEdgesTest, WeightGrowsWithSharpness) {
    const auto largest_weight = [](const TriangleMesh& mesh) {
        double largest = 0;
        for (const SharpEdge& edge : find_sharp_edges(mesh, face_normals(mesh), {40, 1}))
            largest = std::max(largest, edge.weight);
        return largest;
    };
    EXPECT_GT(largest_weight(test::tetrahedron()), 1.1 * largest_weight(test::cube()));
}

TEST(SharpEdgesTest, ThresholdDecides) {
    const TriangleMesh mesh = test::icosphere(1);
    EXPECT_TRUE(find_sharp_edges(mesh, face_normals(mesh), {60, 10}).empty());
    EXPECT_EQ(find_sharp_edges(mesh, face_normals(mesh), {1, 10}).size(), mesh.faces.size() * 3 / 2);
    EXPECT_TRUE(find_sharp_edges(test::cube(), face_normals(test::cube()), {180, 10}).empty());
}

TEST(SharpEdgesTest, BoundaryEdgesAreSharp) {
    TriangleMesh mesh = test::icosphere(2);
    const Triangle gone = mesh.faces.back();
    mesh.faces.pop_back();
    const std::vector<SharpEdge> edges = find_sharp_edges(mesh, face_normals(mesh), {60, 7});
    ASSERT_EQ(edges.size(), 3U);
    for (const SharpEdge& edge : edges) {
        EXPECT_EQ(edge.weight, 7);
        EXPECT_NE(std::find(gone.begin(), gone.end(), edge.a), gone.end());
        EXPECT_NE(std::find(gone.begin(), gone.end(), edge.b), gone.end());
    }
}

}  // namespace
}  // namespace vsplit
