#include "features/boundary_corners.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/core/meshes.h"

namespace vsplit::test {
namespace {

std::vector<std::uint32_t> corners(const TriangleMesh& mesh, double angle, double reach) {
    std::vector<std::uint32_t> found = boundary_corners(mesh, {angle, reach});
    std::sort(found.begin(), found.end());
    return found;
}

TEST(BoundaryCornersTest, FindsThoseOfASquareAtAnyReach) {
    for (const double reach : {0.0, 0.5, 1.0, 2.5}) {
        EXPECT_EQ(corners(square(8), 40, reach), (std::vector<std::uint32_t>{0, 8, 72, 80})) << reach;
        EXPECT_EQ(corners(holed_square(8, 2), 40, 0.3).size(), 12U);
    }
    EXPECT_TRUE(corners(square(8), 91, 0).empty());
    EXPECT_TRUE(corners(cube(), 0, 0).empty()) << "closed";
}

TEST(BoundaryCornersTest, ARoundBoundaryHasNone) {
    EXPECT_TRUE(corners(open_cylinder(24, 2), 40, 0).empty());
    EXPECT_EQ(corners(open_cylinder(8, 2), 40, 0).size(), 16U) << "turns of 45 degrees";
}

TEST(BoundaryCornersTest, TeethWithinReachAreNone) {
    TriangleMesh saw = square(40);
    for (Vec3& p : saw.positions) {
        if (p.y() == 0 && p.x() > 0 && p.x() < 40 && static_cast<int>(p.x()) % 2 != 0) p.y() = -0.5;
    }
    EXPECT_GT(corners(saw, 40, 0).size(), 35U);
    const std::vector<std::uint32_t> left = corners(saw, 40, 2);
    for (const std::uint32_t corner : {0U, 40U, 40U * 41, 41U * 41 - 1}) {
        EXPECT_TRUE(std::binary_search(left.begin(), left.end(), corner)) << corner;
    }
    EXPECT_LE(left.size(), 6U) << "those of the square, and a tooth within reach of one";
}

}  // namespace
}  // namespace vsplit::test
