#include "quality/measure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/core/meshes.h"

namespace vsplit::bench {
namespace {

constexpr MeasureOptions kQuick{.samples = 20'000};

TEST(MeasureTest, AMeshIsNotFarFromItself) {
    const Figures f = measure(test::plate_with_holes(2), test::plate_with_holes(2), kQuick);
    EXPECT_LT(f.deviation, 1e-9);
    EXPECT_EQ(f.crease_lost, 0);
    EXPECT_EQ(f.folds, 0);
    EXPECT_EQ(f.self_intersections, 0);
    EXPECT_EQ(f.border_edges, 0);
}

TEST(MeasureTest, DeviationIsSeenFromBothSides) {
    // Of two cubes one, and of one two: what is missing is as far as what is too much.
    const TriangleMesh two = test::joined(test::cube(), test::cube(), Vec3(3, 0, 0));
    EXPECT_NEAR(measure(test::cube(), two, kQuick).deviation, 100 * 3 / bounding_box(two).diagonal(), 1e-9);
    EXPECT_NEAR(measure(two, test::cube(), kQuick).deviation, 100 * 3 / std::sqrt(3.0), 1e-9);
}

TEST(MeasureTest, SeesADentBetweenTheVertices) {
    // The sphere's chords: no vertex of the coarse one is off the fine one, but the middle of its faces is.
    const Figures f = measure(test::icosphere(1), test::icosphere(4), kQuick);
    EXPECT_GT(f.deviation, 1);
}

TEST(MeasureTest, ThereIsNoCreaseToLoseOnASphere) {
    EXPECT_FALSE(measure(test::icosphere(2), test::icosphere(3), kQuick).crease_lost.has_value());
}

TEST(MeasureTest, ASphereHasLostTheCreasesOfACube) {
    const Figures f = measure(test::icosphere(2), test::cube(), kQuick);
    EXPECT_EQ(f.crease_lost, 100);
    EXPECT_EQ(f.crease_gone, 100);
}

TEST(MeasureTest, ABluntedCreaseIsLostButNotGone) {
    // A roof of 44 degrees, then of 36: the ridge is where it was.
    const auto roof = [](double degrees) {
        const double z = std::tan(degrees / 2 * std::numbers::pi / 180);
        TriangleMesh mesh;
        mesh.positions = {{0, -1, 0}, {0, 1, 0}, {-1, 0, -z}, {1, 0, -z}};
        mesh.faces = {{0, 1, 2}, {1, 0, 3}};
        return mesh;
    };
    const Figures f = measure(roof(36), roof(44), kQuick);
    const double ridge = 2 / (2 + 4 * std::sqrt(2 + std::pow(std::tan(22 * std::numbers::pi / 180), 2)));
    EXPECT_LT(*f.crease_gone, *f.crease_lost - 0.9 * 100 * ridge);
}

TEST(MeasureTest, CountsAFoldUnlessTheSourceHasItToo) {
    TriangleMesh folded;
    folded.positions = {{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0.5, 0.9, 0.01}};
    folded.faces = {{0, 1, 2}, {1, 0, 3}};
    EXPECT_EQ(measure(folded, test::cube(), kQuick).folds, 1);
    EXPECT_EQ(measure(folded, folded, kQuick).folds, 0);
    EXPECT_EQ(measure(folded, folded, kQuick).border_edges, 4);
}

}  // namespace
}  // namespace vsplit::bench
