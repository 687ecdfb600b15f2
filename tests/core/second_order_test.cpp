#include "vsplit/io/second_order.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <map>

#include "tests/core/meshes.h"
#include "vsplit/io/read_mesh.h"
#include "vsplit/io/write_mesh.h"

namespace vsplit::test {
namespace {

constexpr std::array kFormats{MeshFormat::kMsh,       MeshFormat::kMshAscii, MeshFormat::kMsh2,
                              MeshFormat::kMsh2Ascii, MeshFormat::kInp,      MeshFormat::kBdf,
                              MeshFormat::kVtk,       MeshFormat::kVtkAscii, MeshFormat::kVtu};

MidsideNodes nodes_of(const TriangleMesh& mesh, const TriangleMesh& source, unsigned threads = 0) {
    Expected<MidsideNodes> nodes = midside_nodes(mesh, source, ExecutionContext({}, threads));
    EXPECT_TRUE(nodes) << nodes.error().message;
    return nodes ? *std::move(nodes) : MidsideNodes();
}

Vec3 middle(const TriangleMesh& mesh, std::size_t f, std::size_t i) {
    return (mesh.positions[mesh.faces[f][i]] + mesh.positions[mesh.faces[f][(i + 1) % 3]]) / 2;
}

/// The least Jacobian at many points of an element, in the flat triangle's, by differences of the shape itself.
double least_jacobian(const TriangleMesh& mesh, const MidsideNodes& nodes, std::size_t f) {
    std::array<Vec3, 6> x;
    for (std::size_t i = 0; i < 3; ++i) {
        x[i] = mesh.positions[mesh.faces[f][i]];
        x[i + 3] = nodes.positions[nodes.of_face[f][i] - mesh.vertex_count()];
    }
    const auto shape = [&](double u, double v) -> Vec3 {
        const double w = 1 - u - v;
        return w * (2 * w - 1) * x[0] + u * (2 * u - 1) * x[1] + v * (2 * v - 1) * x[2] + 4 * w * u * x[3] + 4 * u * v * x[4] +
               4 * v * w * x[5];
    };
    const Vec3 flat = (x[1] - x[0]).cross(x[2] - x[0]);
    constexpr int kSteps = 8;
    constexpr double kStep = 1e-4;
    double least = 1e300;
    for (int i = 0; i <= kSteps; ++i) {
        for (int j = 0; i + j <= kSteps; ++j) {
            const double u = double(i) / kSteps;
            const double v = double(j) / kSteps;
            const Vec3 by_u = (shape(u + kStep, v) - shape(u - kStep, v)) / (2 * kStep);
            const Vec3 by_v = (shape(u, v + kStep) - shape(u, v - kStep)) / (2 * kStep);
            least = std::min(least, by_u.cross(by_v).dot(flat) / flat.squaredNorm());
        }
    }
    return least;
}

TEST(SecondOrderTest, AnEdgeHasOneNodeAndItIsOnTheSource) {
    const TriangleMesh mesh = icosphere(1);
    const MidsideNodes nodes = nodes_of(mesh, icosphere(5));
    EXPECT_EQ(nodes.positions.size(), mesh.faces.size() * 3 / 2);
    EXPECT_EQ(nodes.on_chord, 0U);
    for (const Vec3& node : nodes.positions) EXPECT_NEAR(node.norm(), 1, 1e-3);  // chords' middles are 0.04 within
    std::map<std::uint32_t, Vec3> seen;
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t node = nodes.of_face[f][i];
            ASSERT_GE(node, mesh.vertex_count());
            const auto [at, is_new] = seen.emplace(node, middle(mesh, f, i));
            EXPECT_TRUE(is_new || at->second == middle(mesh, f, i));
        }
    }
}

TEST(SecondOrderTest, NodesOfAMeshOnItselfStayOnTheirChords) {
    const TriangleMesh mesh = torus(18, 9);
    const MidsideNodes nodes = nodes_of(mesh, mesh);
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec3& node = nodes.positions[nodes.of_face[f][i] - mesh.vertex_count()];
            EXPECT_LT((node - middle(mesh, f, i)).norm(), 1e-12);
        }
    }
}

TEST(SecondOrderTest, NoElementIsInvertedAndThoseGoneBackAreCounted) {
    const TriangleMesh rough = noisy_cube(6, 0.3, 7);
    std::size_t curved = 0;
    const TriangleMesh slivers = sliver_cylinder(40, 3);
    for (const auto& [mesh, source] : {std::pair(rough, noisy_cube(6, 0.3, 8)), std::pair(slivers, bumpy_sphere(3, 0.2, 5)),
                                       std::pair(torus(7, 5), torus(70, 50))}) {
        const MidsideNodes nodes = nodes_of(mesh, source);
        std::uint32_t straight = 0;
        std::vector<Vec3> chord(nodes.positions.size());
        for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
            EXPECT_GE(least_jacobian(mesh, nodes, f), 0.2 - 1e-6) << f;
            for (std::size_t i = 0; i < 3; ++i) chord[nodes.of_face[f][i] - mesh.vertex_count()] = middle(mesh, f, i);
        }
        for (std::size_t i = 0; i < chord.size(); ++i) straight += nodes.positions[i] == chord[i] ? 1U : 0U;
        EXPECT_LE(nodes.on_chord, straight);
        curved += chord.size() - straight;
    }
    EXPECT_GT(curved, 0U);
    EXPECT_GT(nodes_of(rough, noisy_cube(6, 0.3, 8)).on_chord, 0U);
}

TEST(SecondOrderTest, EveryFormatOfElementsIsReadBackByItsCorners) {
    TriangleMesh mesh = torus(18, 9);
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) mesh.regions.push_back(1 + f * 3 / mesh.face_count());
    mesh.sets = {{"inlet", {1}}, {"wall", {2}}, {"outlet", {3}}};
    const MidsideNodes nodes = nodes_of(mesh, torus(90, 45));
    for (const MeshFormat format : kFormats) {
        EXPECT_TRUE(has_second_order(format));
        const Expected<std::string> bytes = write_second_order(mesh, nodes, format);
        ASSERT_TRUE(bytes) << format_name(format);
        EXPECT_GT(bytes->size(), write_mesh(mesh, format).size());
        const Expected<ReadResult> again = read_mesh(std::as_bytes(std::span(*bytes)), {});
        ASSERT_TRUE(again) << format_name(format) << ": " << again.error().message;
        EXPECT_EQ(again->mesh.faces, mesh.faces) << format_name(format);
        EXPECT_EQ(again->mesh.regions, mesh.regions) << format_name(format);
    }
    const Expected<std::string> refused = write_second_order(mesh, nodes, MeshFormat::kStlBinary);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().cause, Cause::kUnsupported);
    EXPECT_EQ(refused.error().field, "order");
}

TEST(SecondOrderTest, TheSameForAnyNumberOfThreadsAndNothingWithoutASource) {
    const TriangleMesh mesh = icosphere(3);
    EXPECT_EQ(nodes_of(mesh, icosphere(5), 1).positions, nodes_of(mesh, icosphere(5), 4).positions);
    EXPECT_FALSE(midside_nodes(mesh, {}, ExecutionContext()));
}

}  // namespace
}  // namespace vsplit::test
