#include <gtest/gtest.h>

#include "quality/creases.h"
#include "tests/core/meshes.h"

namespace vsplit::bench {
namespace {

double length(const std::vector<Segment>& segments) {
    double sum = 0;
    for (const Segment& s : segments) sum += (s[1] - s[0]).norm();
    return sum;
}

TEST(CreasesTest, FindsTheTwelveEdgesOfACube) {
    const std::vector<Segment> found = sharp_segments(test::cube(), 40);
    EXPECT_EQ(found.size(), 12);
    EXPECT_DOUBLE_EQ(length(found), 12);
    EXPECT_TRUE(sharp_segments(test::cube(), 91).empty());
}

TEST(CreasesTest, FindsTheBorderOfAnOpenMesh) {
    TriangleMesh open = test::cube();
    EXPECT_TRUE(border_segments(open).empty());
    open.faces.pop_back();
    const std::vector<Segment> border = border_segments(open);
    EXPECT_EQ(border.size(), 3);
    EXPECT_NEAR(length(border), 2 + std::sqrt(2.0), 1e-12);
}

}  // namespace
}  // namespace vsplit::bench
