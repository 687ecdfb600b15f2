#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tests/core/meshes.h"
#include "tests/core/random.h"
#include "vsplit/quality/mesh_quality.h"
#include "vsplit/quality/stretch.h"

namespace vsplit {
namespace {

/// Eq. 6 as the paper prints it.
double stretch_by_heron(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double x = (a - b).norm();
    const double y = (b - c).norm();
    const double z = (c - a).norm();
    const double s = (x + y + z) / 2;
    return std::sqrt(12) * std::sqrt((s - x) * (s - y) * (s - z) / s) / std::max({x, y, z});
}

TEST(StretchTest, EqualsThePapersFormula) {
    test::Random random(5);
    const auto point = [&] { return Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)); };
    for (int round = 0; round < 1000; ++round) {
        const Vec3 a = point();
        const Vec3 b = point();
        const Vec3 c = point();
        EXPECT_NEAR(stretch(a, b, c), stretch_by_heron(a, b, c), 1e-6);
    }
}

TEST(StretchTest, IsOneForEquilateralAndZeroForDegenerate) {
    EXPECT_NEAR(stretch(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.5, std::sqrt(3) / 2, 0)), 1, 1e-15);
    EXPECT_EQ(stretch(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(3, 0, 0)), 0);
    EXPECT_EQ(stretch(Vec3(1, 1, 1), Vec3(1, 1, 1), Vec3(1, 1, 1)), 0);
    EXPECT_EQ(face_size(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(3, 0, 0)), 3);
}

TEST(QualityTest, AgreesWithCountingByHand) {
    for (const test::NamedMesh& m : test::small_meshes()) {
        SCOPED_TRACE(m.name);
        const Quality q = measure_quality(m.mesh);
        std::vector<double> all;
        for (const Triangle& t : m.mesh.faces) {
            all.push_back(stretch(m.mesh.positions[t[0]], m.mesh.positions[t[1]], m.mesh.positions[t[2]]));
        }
        std::sort(all.begin(), all.end());
        EXPECT_EQ(q.faces, all.size());
        EXPECT_EQ(q.stretch_min, all.front());
        EXPECT_EQ(q.stretch_p01, all[all.size() / 100]);
        EXPECT_NEAR(q.stretch_mean, std::accumulate(all.begin(), all.end(), 0.0) / static_cast<double>(all.size()), 1e-12);
        EXPECT_EQ(q.faces_below_02, std::count_if(all.begin(), all.end(), [](double s) { return s < 0.2; }));
        EXPECT_EQ(std::accumulate(q.stretch_histogram.begin(), q.stretch_histogram.end(), 0U), all.size());
        EXPECT_FALSE(q.deviation_max.has_value());
    }
}

TEST(QualityTest, CountsEdgesAtBoundaryVerticesToo) {
    TriangleMesh strip;
    strip.positions = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)};
    strip.faces = {{0, 1, 2}, {0, 2, 3}};
    EXPECT_EQ(measure_quality(strip).valence_max, 3U);
    EXPECT_EQ(measure_quality(test::tetrahedron()).valence_max, 3U);
    EXPECT_EQ(measure_quality(test::icosphere(2)).valence_max, 6U);
    EXPECT_EQ(measure_quality({}).valence_max, 0U);
}

TEST(QualityTest, WorstFacesAreTheWorstInOrder) {
    const TriangleMesh mesh = test::bumpy_sphere(2, 0.1, 7);
    const std::vector<FaceQuality> worst = worst_faces(mesh, 10);
    ASSERT_EQ(worst.size(), 10U);
    EXPECT_EQ(worst.front().stretch, measure_quality(mesh).stretch_min);
    EXPECT_TRUE(std::is_sorted(worst.begin(), worst.end(), [](const auto& l, const auto& r) { return l.stretch < r.stretch; }));
    EXPECT_EQ(worst_faces(mesh, 1'000'000).size(), mesh.faces.size());
    EXPECT_TRUE(worst_faces({}, 5).empty());
}

}  // namespace
}  // namespace vsplit
