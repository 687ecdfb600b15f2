#include "method/cut_needles.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "spatial/surface_index.h"
#include "tests/core/meshes.h"
#include "vsplit/features/face_normals.h"
#include "vsplit/mesh/inspect.h"
#include "vsplit/method/improve.h"
#include "vsplit/subdivide/subdivide.h"

namespace vsplit::test {
namespace {

/// A rod of twelve sides, each two needles, turned out of the axes and with coordinates in single precision, as files have them.
TriangleMesh cable(double length) {
    TriangleMesh mesh = sliver_cylinder(12, length);
    const Eigen::AngleAxisd turn(0.7, Vec3(1, 2, 3).normalized());
    for (Vec3& p : mesh.positions) p = (turn * p).cast<float>().cast<double>();
    return mesh;
}

CreasedMesh creased(const TriangleMesh& mesh) { return {mesh, find_creases(mesh, face_normals(mesh), {}), 0}; }

double length_of(const TriangleMesh& mesh, const std::vector<SharpEdge>& edges) {
    double sum = 0;
    for (const SharpEdge& edge : edges) sum += (mesh.positions[edge.a] - mesh.positions[edge.b]).norm();
    return sum;
}

/// Faces whose longest edge is more than six times their height over it.
std::size_t needles(const TriangleMesh& mesh) {
    return static_cast<std::size_t>(std::count_if(mesh.faces.begin(), mesh.faces.end(), [&](const Triangle& t) {
        const Vec3 &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
        const double square = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
        return square > 6 * (b - a).cross(c - a).norm();
    }));
}

TEST(CutNeedlesTest, StripsBecomeRowsOfFacesAndTheSurfaceStays) {
    const TriangleMesh source = cable(2000);
    const CreasedMesh before = creased(source);
    const CreasedMesh cut = cut_needles(before, 0.1, 0.01, {});
    EXPECT_GE(needles(source), 24U);
    EXPECT_LE(needles(cut.mesh), 200U);  // of the ends
    EXPECT_LT(cut.mesh.face_count(), 60'000U);
    EXPECT_GT(predict_subdivision(source, 1.5, 1'000'000), 1'000'000U);  // with midpoints alone
    EXPECT_TRUE(require_closed_manifold(inspect(cut.mesh)));
    EXPECT_TRUE(std::equal(source.positions.begin(), source.positions.end(), cut.mesh.positions.begin()));
    EXPECT_LE(cut.moved, 0.01);
    EXPECT_NEAR(enclosed_volume(cut.mesh), enclosed_volume(source), 1e-6 * enclosed_volume(source));
    EXPECT_NEAR(length_of(cut.mesh, cut.creases), length_of(source, before.creases), 1e-6 * length_of(source, before.creases));
    const SurfaceIndex index = surface_index(source);
    for (const Vec3& p : cut.mesh.positions) ASSERT_LE(std::sqrt(index.closest(p).squared_distance), 1e-9);
    for (const Triangle& t : cut.mesh.faces) {
        const Vec3 middle = (cut.mesh.positions[t[0]] + cut.mesh.positions[t[1]] + cut.mesh.positions[t[2]]) / 3;
        ASSERT_LE(std::sqrt(index.closest(middle).squared_distance), cut.moved + 1e-9);
    }
}

TEST(CutNeedlesTest, NothingIsCutBelowTheSize) {
    const CreasedMesh cut = cut_needles(creased(cable(10000)), 100, 0.01, {});
    EXPECT_GT(cut.mesh.face_count(), 2000);
    EXPECT_LT(cut.mesh.face_count(), 10'000);
}

TEST(CutNeedlesTest, BoundariesStay) {
    TriangleMesh open = cable(10000);
    open.faces.resize(open.faces.size() - 1);
    const MeshReport before = inspect(open);
    const MeshReport after = inspect(cut_needles(creased(open), 10, 0.01, {}).mesh);
    EXPECT_EQ(after.boundary_edges, before.boundary_edges);
    EXPECT_TRUE(require_manifold(after));
}

TEST(CutNeedlesTest, ACableIsImprovedByDefaultsAtTheScaleOfItsGirth) {
    const TriangleMesh source = cable(20000);
    const Expected<MethodResult> result = improve(source, {}, {}, {});
    ASSERT_TRUE(result.has_value());
    EXPECT_GT(result->quality.stretch_mean, 0.6);  // 0.0 with faces of 1.5 % of the length
    EXPECT_LT(*result->quality.deviation_max, 2);  // 40 were allowed if it went by the length
}

}  // namespace
}  // namespace vsplit::test
