#include "io/cut_polygon.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <chrono>
#include <cmath>

#include "tests/core/random.h"

namespace vsplit {
namespace {

constexpr double kPi = 3.141592653589793;

Vec3 area_of(const std::vector<Vec3>& polygon, const Triangle& t) {
    return (polygon[t[1]] - polygon[t[0]]).cross(polygon[t[2]] - polygon[t[0]]) / 2;
}

/// Every triangle runs as the polygon does, and together they are as large.
void expect_no_fold(const std::vector<Vec3>& polygon) {
    const std::vector<Triangle> triangles = cut_polygon(polygon);
    ASSERT_EQ(triangles.size(), polygon.size() - 2);
    Vec3 normal = Vec3::Zero();
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
        normal += area_of(polygon, {0, static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(i + 1)});
    double all = 0;
    for (const Triangle& t : triangles) {
        EXPECT_GE(area_of(polygon, t).dot(normal), -1e-12 * normal.squaredNorm());
        all += area_of(polygon, t).norm();
    }
    EXPECT_NEAR(all, normal.norm(), 1e-9 * normal.norm());
}

/// The plane turned into space.
std::vector<Vec3> turned(const std::vector<Vec3>& flat, double a, double b) {
    std::vector<Vec3> result;
    for (const Vec3& p : flat) {
        const Vec3 q(std::cos(a) * p.x() - std::sin(a) * p.y(), std::sin(a) * p.x() + std::cos(a) * p.y(), 5);
        result.emplace_back(q.x(), std::cos(b) * q.y() - std::sin(b) * q.z(), std::sin(b) * q.y() + std::cos(b) * q.z());
    }
    return result;
}

TEST(CutPolygonTest, ConvexOnesAreTheFanOfTheirFirstCorner) {
    std::vector<Vec3> polygon;
    std::vector<Triangle> fan;
    for (std::uint32_t i = 0; i < 40; ++i) {
        polygon.emplace_back(std::cos(kPi * i / 20), std::sin(kPi * i / 20), 0);
        if (i >= 2) fan.push_back({0, i - 1, i});
    }
    EXPECT_EQ(cut_polygon(polygon), fan);
    EXPECT_EQ(cut_polygon(turned(polygon, 1, 2)), fan);
}

TEST(CutPolygonTest, ACornerInTheMiddleOfASideMakesNoFaceOfNoArea) {
    const std::vector<std::vector<Vec3>> polygons = {
        {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}},                                              // one
        {{2, 2, 0}, {0, 0, 0}, {1, 0, 0}, {2, 0, 0}},                                              // elsewhere
        {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}, {4, 4, 0}},                        // several
        {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0}},  // on all sides
        {{0, 0, 0}, {0.1, 0.3, 0}, {0.2, 0.6, 0}, {0.3, 0.9, 0}, {-1, 1, 0}},              // in the middle but for rounding
        {{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {2, 1, 0}, {1.5, 1, 0}, {1, 1, 0}, {0, 3, 0}}};  // of a dent
    for (const std::vector<Vec3>& polygon : polygons) {
        for (std::size_t first = 0; first < polygon.size(); ++first) {
            std::vector<Vec3> moved = polygon;
            std::rotate(moved.begin(), moved.begin() + static_cast<std::ptrdiff_t>(first), moved.end());
            for (const std::vector<Vec3>& seen : {moved, turned(moved, 1, 2)}) {
                expect_no_fold(seen);
                for (const Triangle& t : cut_polygon(seen)) EXPECT_GT(area_of(seen, t).norm(), 1e-3);
            }
        }
    }
    // Of a side of very many corners some cut is made, whatever it takes.
    std::vector<Vec3> comb = {{0, 1, 0}};
    for (int i = 0; i <= 20000; ++i) comb.emplace_back(i, 0, 0);
    EXPECT_EQ(cut_polygon(comb).size(), comb.size() - 2);
}

TEST(CutPolygonTest, ConcaveOnesDoNotFold) {
    const std::vector<Vec3> notched = {{4, 4, 0}, {2, 1, 0}, {0, 4, 0}, {0, 0, 0}, {4, 0, 0}};
    const std::vector<Vec3> arrow = {{0, 0, 0}, {2, 1, 0}, {0, 2, 0}, {1, 1, 0}};
    std::vector<Vec3> comb;
    for (int tooth = 0; tooth < 20; ++tooth) {
        comb.emplace_back(2 * tooth, 5, 0);
        comb.emplace_back(2 * tooth + 1, 5, 0);
        comb.emplace_back(2 * tooth + 1, 1, 0);
        comb.emplace_back(2 * tooth + 2, 1, 0);
    }
    comb.emplace_back(40, 0, 0);
    comb.emplace_back(0, 0, 0);
    // A square with a square hole, joined by an edge that runs both ways.
    const std::vector<Vec3> keyhole = {{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 9, 0}, {0, 0, 0},
                                       {3, 3, 0}, {3, 6, 0}, {6, 6, 0}, {6, 3, 0}, {3, 3, 0}};
    for (const std::vector<Vec3>& polygon : {notched, arrow, comb, keyhole}) {
        for (std::size_t first = 0; first < polygon.size(); ++first) {
            std::vector<Vec3> rolled(polygon.begin() + static_cast<std::ptrdiff_t>(first), polygon.end());
            rolled.insert(rolled.end(), polygon.begin(), polygon.begin() + static_cast<std::ptrdiff_t>(first));
            expect_no_fold(rolled);
            expect_no_fold(turned(rolled, 0.3, 1.1));
            expect_no_fold(std::vector<Vec3>(rolled.rbegin(), rolled.rend()));
        }
    }
}

TEST(CutPolygonTest, StarsOfAnyShapeDoNotFold) {
    test::Random random(3);
    for (int trial = 0; trial < 300; ++trial) {
        std::vector<Vec3> star;
        const int corners = 4 + trial % 60;
        for (int i = 0; i < corners; ++i) {
            const double radius = random.uniform(0.1, 1);
            star.emplace_back(radius * std::cos(2 * kPi * i / corners), radius * std::sin(2 * kPi * i / corners), 0);
        }
        expect_no_fold(turned(star, random.uniform(0, 6), random.uniform(0, 6)));
    }
}

TEST(CutPolygonTest, LongOnesAreBounded) {
    const auto seconds = [](const auto& work) {
        const auto begin = std::chrono::steady_clock::now();
        work();
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    };
    std::vector<Vec3> gear;
    std::vector<Vec3> comb;  // hostile: every tooth reaches along x as far as all others
    constexpr int kCorners = 100'000;
    for (int i = 0; i < kCorners; ++i) {
        const double radius = i % 2 == 0 ? 1 : 0.99;
        gear.emplace_back(radius * std::cos(2 * kPi * i / kCorners), radius * std::sin(2 * kPi * i / kCorners), 0);
        comb.emplace_back(i % 2 == 0 ? 1e6 : 0, i, 0);
    }
    comb.emplace_back(-1e6, kCorners, 0);
    comb.emplace_back(-1e6, 0, 0);
    EXPECT_LT(seconds([&] { expect_no_fold(gear); }), 20);
    EXPECT_LT(seconds([&] { static_cast<void>(cut_polygon(comb)); }), 20);
}

TEST(CutPolygonTest, WhatHasNoCutIsStillTriangles) {
    const std::vector<Vec3> bow_tie = {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}};
    const std::vector<Vec3> line = {{0, 0, 0}, {1, 1, 1}, {3, 3, 3}, {2, 2, 2}, {5, 5, 5}};
    const std::vector<Vec3> point(6, Vec3(1, 2, 3));
    std::vector<Vec3> pentagram;
    for (int i = 0; i < 5; ++i) pentagram.emplace_back(std::cos(0.8 * kPi * i), std::sin(0.8 * kPi * i), 0);
    for (const std::vector<Vec3>& polygon : {bow_tie, line, point, pentagram}) {
        const std::vector<Triangle> triangles = cut_polygon(polygon);
        EXPECT_EQ(triangles.size(), polygon.size() - 2);
        for (const Triangle& t : triangles) {
            for (const std::uint32_t corner : t) EXPECT_LT(corner, polygon.size());
            EXPECT_TRUE(t[0] != t[1] && t[1] != t[2] && t[2] != t[0]);
        }
    }
}

}  // namespace
}  // namespace vsplit
