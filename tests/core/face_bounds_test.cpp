#include "quality/face_bounds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/core/random.h"
#include "vsplit/quality/stretch.h"

namespace vsplit::test {
namespace {

constexpr double kDegree = 0.017453292519943295;

double angle_at(const Vec3& corner, const Vec3& one, const Vec3& other) {
    const Vec3 u = one - corner, v = other - corner;
    return std::atan2(u.cross(v).norm(), u.dot(v));
}

TEST(FaceBoundsTest, FiguresAreThoseOfTheDefinitions) {
    Random random(3);
    const auto point = [&] { return Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)); };
    for (int n = 0; n < 2000; ++n) {
        const Vec3 a = point(), b = point(), c = n % 3 == 0 ? Vec3(a + 1e-3 * point()) : point();
        const FaceFigures face(a, b, c);
        std::array<double, 3> sides{(a - b).norm(), (b - c).norm(), (c - a).norm()};
        std::array<double, 3> angles{angle_at(a, b, c), angle_at(b, c, a), angle_at(c, a, b)};
        std::sort(sides.begin(), sides.end());
        std::sort(angles.begin(), angles.end());
        EXPECT_DOUBLE_EQ(face.longest, sides[2]);
        EXPECT_DOUBLE_EQ(face.middle, sides[1]);
        EXPECT_DOUBLE_EQ(face.shortest, sides[0]);
        EXPECT_DOUBLE_EQ(face.stretch, stretch(a, b, c));
        EXPECT_NEAR(face.least_sine(), std::sin(angles[0]), 1e-9);
        EXPECT_NEAR(face.least_cosine(), std::cos(angles[2]), 1e-9);
        EXPECT_NEAR(face.aspect(), sides[2] / sides[0], 1e-9 * face.aspect());
    }
}

TEST(FaceBoundsTest, WhatIsDegenerateBreaksEveryBoundOnShape) {
    const Vec3 p(1, 2, 3), q(2, 2, 3), r(4, 2, 3);
    FaceBounds bounds;
    bounds.min_stretch = 0.1;
    bounds.min_sine = std::sin(kDegree);
    bounds.min_cosine = std::cos(179 * kDegree);
    bounds.max_aspect = 100;
    for (const FaceFigures& face : {FaceFigures(p, p, p), FaceFigures(p, p, q)}) {
        EXPECT_EQ(bounds.lacks_stretch(face), 1);
        EXPECT_EQ(bounds.lacks_min_angle(face), 1);
        EXPECT_EQ(bounds.lacks_max_angle(face), 1);
        EXPECT_EQ(bounds.lacks_aspect(face), 1);
    }
    const FaceFigures line(p, q, r);
    EXPECT_EQ(bounds.lacks_min_angle(line), 1);
    EXPECT_EQ(bounds.lacks_max_angle(line), 1);
    EXPECT_EQ(bounds.lacks_aspect(line), 0);
}

TEST(FaceBoundsTest, NothingIsLackedWithoutABoundAndEachBoundAlone) {
    const FaceFigures face(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 0.5, 0));
    EXPECT_FALSE(FaceBounds().shaped());
    EXPECT_TRUE(FaceBounds().excess(face).none());
    const auto with = [](auto set) {
        FaceBounds bounds;
        set(bounds);
        return bounds;
    };
    const std::array<FaceBounds, 5> broken{
        with([](FaceBounds& b) { b.min_stretch = 0.99; }), with([](FaceBounds& b) { b.min_size = 2; }),
        with([](FaceBounds& b) { b.min_sine = 0.6; }), with([](FaceBounds& b) { b.min_cosine = 0.1; }),
        with([](FaceBounds& b) { b.max_aspect = 2; })};
    for (std::size_t n = 0; n < broken.size(); ++n) {
        EXPECT_EQ(broken[n].shaped(), n > 0) << n;
        EXPECT_GT(broken[n].excess(face).sum, 0) << n;
        EXPECT_LE(broken[n].excess(face).sum, 1) << n;
        EXPECT_EQ(broken[n].excess(face).kinds, 1U << n) << n;
    }
}

TEST(FaceBoundsTest, AnExcessLessensOnlyWhereNothingGetsWorse) {
    const Excess before{0.5, 0.7, 5};
    EXPECT_TRUE((Excess{0.5, 0.6, 4}.lessens(before)));
    EXPECT_FALSE((Excess{0.5, 0.6, 2}.lessens(before))) << "another bound broke";
    EXPECT_FALSE((Excess{0.5, 0.7, 5}.lessens(before)));
    EXPECT_FALSE((Excess{0.6, 0.6, 5}.lessens(before)));
    EXPECT_TRUE((Excess{}.may_follow(Excess{})));
    EXPECT_FALSE((Excess{0.1, 0.1, 1}.may_follow(Excess{})));
    Excess sum{0.2, 0.2, 2};
    sum.add(Excess{0.5, 0.7, 1});
    EXPECT_EQ(sum.worst, 0.5);
    EXPECT_DOUBLE_EQ(sum.sum, 0.9);
    EXPECT_EQ(sum.kinds, 3U);
}

}  // namespace
}  // namespace vsplit::test
