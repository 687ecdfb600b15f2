#include "quality/distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/core/meshes.h"
#include "tests/core/random.h"

namespace vsplit::bench {
namespace {

TEST(DistanceTest, IsThatOfACube) {
    const Distance cube(test::cube());
    test::Random random(1);
    for (int i = 0; i < 1000; ++i) {
        const Vec3 p(random.uniform(-1, 2), random.uniform(-1, 2), random.uniform(-1, 2));
        const Vec3 outside = (-p).cwiseMax(p - Vec3::Ones()).cwiseMax(0);
        const double inside = std::min(p.minCoeff(), (Vec3::Ones() - p).minCoeff());
        EXPECT_NEAR(cube.distance(p), inside > 0 ? inside : outside.norm(), 1e-12);
    }
}

TEST(DistanceTest, IsNothingAtTheVerticesOfSlivers) {
    const TriangleMesh slivers = test::sliver_cylinder(64, 50);
    const Distance distance(slivers);
    for (const Vec3& p : slivers.positions) EXPECT_NEAR(distance.distance(p), 0, 1e-9);
}

TEST(DistanceTest, OfSegmentsIsTheLeastOfEach) {
    const Distance two({{Vec3(0, 0, 0), Vec3(1, 0, 0)}, {Vec3(3, 0, 0), Vec3(3, 0, 0)}});
    EXPECT_DOUBLE_EQ(two.distance({0.5, 2, 0}), 2);
    EXPECT_DOUBLE_EQ(two.distance({-3, 4, 0}), 5);
    EXPECT_DOUBLE_EQ(two.distance({3, 0, 0.25}), 0.25);
}

TEST(DistanceTest, OfNothingIsInfinite) { EXPECT_TRUE(std::isinf(Distance(std::vector<Segment>{}).distance(Vec3::Zero()))); }

}  // namespace
}  // namespace vsplit::bench
