#include "vsplit/quality/self_intersections.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <utility>
#include <vector>

#include "tests/core/meshes.h"
#include "tests/core/random.h"

namespace vsplit {
namespace {

std::size_t count_self_intersections(const TriangleMesh& mesh) { return find_self_intersections(mesh)->size(); }

TEST(SelfIntersectionsTest, ThereAreNoneInGoodMeshes) {
    for (const auto& [name, mesh] : test::small_meshes()) EXPECT_EQ(count_self_intersections(mesh), 0) << name;
}

TEST(SelfIntersectionsTest, CountsThePairsWhereOneTriangleCutsAnother) {
    // One upright triangle through the first of two flat ones, clear of the second.
    TriangleMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0},      {0, 1, 0},     {5, 0, 0},    {6, 0, 0},
                      {5, 1, 0}, {0.2, 0.2, -1}, {0.3, 0.2, 1}, {0.2, 0.3, 1}};
    mesh.faces = {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}};
    ASSERT_EQ(count_self_intersections(mesh), 1);
    EXPECT_EQ((*find_self_intersections(mesh))[0], (std::array<std::uint32_t, 2>{0, 2}));
    mesh.faces = {{0, 1, 2}, {3, 4, 5}, {0, 7, 8}};
    EXPECT_EQ(count_self_intersections(mesh), 0) << "a common vertex is no intersection";
}

/// A sum of products of small integers over another: compared without rounding.
struct Fraction {
    std::int64_t over = 0;
    std::int64_t under = 1;  // > 0

    friend bool operator<(const Fraction& l, const Fraction& r) { return l.over * r.under < r.over * l.under; }
};

using Point = Eigen::Matrix<std::int64_t, 3, 1>;
using Points = std::array<Point, 3>;

Point normal_of(const Points& t) { return (t[1] - t[0]).cross(t[2] - t[0]); }

/// Where `t` cuts the plane of normal `n` through `at`, along `d`; empty where it does not reach both sides.
std::optional<std::pair<Fraction, Fraction>> part_of_line(const Points& t, const Point& n, const Point& at, const Point& d) {
    std::array<std::int64_t, 3> height{};
    for (std::size_t i = 0; i < 3; ++i) height[i] = n.dot(t[i] - at);
    if (*std::min_element(height.begin(), height.end()) >= 0 || *std::max_element(height.begin(), height.end()) <= 0) return {};
    std::vector<Fraction> cuts;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3;
        if (height[i] == 0) cuts.push_back({d.dot(t[i]), 1});
        if (height[i] * height[j] >= 0) continue;
        const std::int64_t over = d.dot(t[i]) * height[j] - d.dot(t[j]) * height[i];
        const std::int64_t under = height[j] - height[i];
        cuts.push_back({under < 0 ? -over : over, std::abs(under)});
    }
    return std::pair(*std::min_element(cuts.begin(), cuts.end()), *std::max_element(cuts.begin(), cuts.end()));
}

TEST(SelfIntersectionsTest, AgreesWithExactArithmeticOnAGrid) {
    test::Random random(5);
    std::size_t crossing = 0;
    for (int trial = 0; trial < 50'000; ++trial) {
        std::array<Points, 2> pair;
        TriangleMesh mesh;
        for (Points& t : pair) {
            for (Point& p : t) {
                p = Point(random.below(4), random.below(4), random.below(4));
                mesh.positions.push_back(p.cast<double>());
            }
        }
        mesh.faces = {{0, 1, 2}, {3, 4, 5}};
        const Point n = normal_of(pair[0]);
        const Point m = normal_of(pair[1]);
        const auto first = part_of_line(pair[0], m, pair[1][0], n.cross(m));
        const auto second = part_of_line(pair[1], n, pair[0][0], n.cross(m));
        const bool expected = first && second && first->first < second->second && second->first < first->second;
        ASSERT_EQ(count_self_intersections(mesh), expected ? 1U : 0U) << trial;
        crossing += expected ? 1 : 0;
    }
    EXPECT_GT(crossing, 5000U);
}

TEST(SelfIntersectionsTest, BoxesOnAGridThatOverlapAreFound) {
    for (const Vec3& offset : {Vec3(0.5, 0.5, 0.5), Vec3(0.5, 0.5, 0.25), Vec3(-0.5, 0.5, 0.5), Vec3(0.4, 0.45, 0.37)})
        EXPECT_GE(count_self_intersections(test::joined(test::cube(), test::cube(), offset)), 6) << offset.transpose();
}

TEST(SelfIntersectionsTest, TouchingIsNone) {
    const TriangleMesh stacked = test::joined(test::cube(), test::cube(), Vec3(0.25, 0.25, 1));
    EXPECT_EQ(count_self_intersections(stacked), 0);
}

TEST(SelfIntersectionsTest, FindsTwoCrossingSpheresInAnyOrder) {
    const TriangleMesh crossing = test::joined(test::icosphere(2), test::icosphere(2), Vec3(0.7, 0.3, 0.2));
    const std::size_t found = count_self_intersections(crossing);
    EXPECT_GT(found, 20);
    EXPECT_EQ(count_self_intersections(test::shuffled(crossing, 7)), found);
    EXPECT_EQ(count_self_intersections(test::joined(test::icosphere(2), test::icosphere(2), Vec3(3, 0, 0))), 0);
}

}  // namespace
}  // namespace vsplit
