#include "vsplit/simplify/quadric.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "simplify/placement.h"
#include "tests/core/random.h"

namespace vsplit {
namespace {

Vec3 random_point(test::Random& random, double extent = 10) {
    return {random.uniform(-extent, extent), random.uniform(-extent, extent), random.uniform(-extent, extent)};
}

Vec3 random_direction(test::Random& random) {
    Vec3 d = random_point(random);
    while (d.norm() < 0.1) d = random_point(random);
    return d.normalized();
}

double squared_distance_to_plane(const Vec3& x, const Vec3& normal, const Vec3& point) {
    const double d = normal.dot(x - point);
    return d * d;
}

double squared_distance_to_line(const Vec3& x, const Vec3& direction, const Vec3& point) {
    return (x - point).cross(direction).squaredNorm();
}

TEST(QuadricTest, SumOfPlanesAndLinesEqualsBruteForce) {
    test::Random random(1);
    for (int round = 0; round < 2000; ++round) {
        const Vec3 x = random_point(random);
        Quadric sum;
        double expected = 0;
        for (std::uint32_t terms = 1 + random.below(12); terms > 0; --terms) {
            const Vec3 at = random_point(random);
            const Vec3 along = random_direction(random);
            const double weight = random.uniform(0, 20);
            if (random.below(2) == 0) {
                sum += Quadric::plane(along, at);
                expected += squared_distance_to_plane(x, along, at);
            } else {
                sum += Quadric::line(along, at, weight);
                expected += weight * squared_distance_to_line(x, along, at);
            }
        }
        ASSERT_NEAR(sum.error(x), expected, 1e-9 * (1 + expected));
    }
}

TEST(QuadricTest, ErrorIsZeroOnThePlaneAndOnTheLine) {
    test::Random random(2);
    for (int round = 0; round < 500; ++round) {
        const Vec3 point = random_point(random);
        const Vec3 d = random_direction(random);
        EXPECT_NEAR(Quadric::line(d, point, 7).error(point), 0, 1e-10);
        EXPECT_NEAR(Quadric::line(d, point, 7).error(point + 3.5 * d), 0, 1e-10);
        EXPECT_NEAR(Quadric::plane(d, point).error(point + d.unitOrthogonal()), 0, 1e-10);
    }
}

TEST(QuadricTest, HalfGradientIsThatOfTheError) {
    test::Random random(3);
    const Quadric q = Quadric::plane(random_direction(random), random_point(random)) +
                      Quadric::line(random_direction(random), random_point(random), 4);
    const Vec3 x = random_point(random);
    constexpr double kStep = 1e-5;
    for (int axis = 0; axis < 3; ++axis) {
        const Vec3 step = Vec3::Unit(axis) * kStep;
        EXPECT_NEAR(2 * q.half_gradient(x)[axis], (q.error(x + step) - q.error(x - step)) / (2 * kStep), 1e-4);
    }
}

TEST(PlacementTest, MinimumOfThreePlanesIsTheirCorner) {
    const Vec3 corner(1, -2, 3);
    const Quadric q =
        Quadric::plane(Vec3::UnitX(), corner) + Quadric::plane(Vec3::UnitY(), corner) + Quadric::plane(Vec3::UnitZ(), corner);
    const std::optional<Vec3> best = minimum(q);
    ASSERT_TRUE(best.has_value());
    EXPECT_NEAR((*best - corner).norm(), 0, 1e-12);
}

TEST(PlacementTest, PlanesAndCreasesHaveNoMinimumPoint) {
    const Quadric plane = Quadric::plane(Vec3::UnitZ(), Vec3::Zero());
    EXPECT_FALSE(minimum(Quadric{}).has_value());
    EXPECT_FALSE(minimum(plane + plane).has_value());
    EXPECT_FALSE(minimum(plane + Quadric::plane(Vec3::UnitX(), Vec3::Zero())).has_value());
}

TEST(PlacementTest, ProjectionMovesOntoPlaneAndCreaseAndNotAlong) {
    const Quadric plane = Quadric::plane(Vec3::UnitZ(), Vec3(0, 0, 2));
    EXPECT_NEAR((project_to_minimum(plane, Vec3(5, 6, 7)) - Vec3(5, 6, 2)).norm(), 0, 0.02);
    const Quadric crease = plane + Quadric::plane(Vec3::UnitX(), Vec3(1, 0, 0));
    EXPECT_NEAR((project_to_minimum(crease, Vec3(5, 6, 7)) - Vec3(1, 6, 2)).norm(), 0, 0.02);
    EXPECT_EQ(project_to_minimum(Quadric{}, Vec3(5, 6, 7)), Vec3(5, 6, 7));
}

}  // namespace
}  // namespace vsplit
