#include "method/reachable_bounds.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/core/meshes.h"
#include "vsplit/method/control.h"
#include "vsplit/method/improve.h"

namespace vsplit::test {
namespace {

void expect_refused(const TriangleMesh& mesh, const ControlOptions& options, const std::string& field,
                    const std::string& accepted) {
    const ExecutionContext context;
    const auto refused = control(mesh, options, {}, context);
    ASSERT_FALSE(refused) << field;
    EXPECT_EQ(refused.error().cause, Cause::kInvalidOption);
    EXPECT_EQ(refused.error().field, field);
    EXPECT_NE(refused.error().message.find("accepted is " + accepted), std::string::npos) << refused.error().message;
}

TEST(ReachableBoundsTest, NoFaceIsLongerThanItsComponent) {
    expect_refused(cube(), {.min_size = 1.8}, "min_size", "at most 1.73205");
    EXPECT_TRUE(check_reachable(cube(), ControlOptions{.min_size = 1.7}));
    EXPECT_TRUE(check_reachable(cube(), ControlOptions{.max_deviation = 0.1, .min_size = 1.8})) << "it may be as much larger";
    TriangleMesh small = cube();
    for (Vec3& p : small.positions) p /= 10;
    expect_refused(joined(cube(), small, Vec3(3, 0, 0)), {.min_size = 0.5}, "min_size", "at most 0.173205");
}

TEST(ReachableBoundsTest, AMeanValenceOverSixLeavesNoBoundOfSix) {
    expect_refused(plate_with_holes(2), {.max_valence = 6}, "max_valence", "at least 7, since the source has a genus of 2");
    expect_refused(joined(cube(), plate_with_holes(3), Vec3(9, 0, 0)), {.max_valence = 6}, "max_valence", "at least 7");
    EXPECT_TRUE(check_reachable(plate_with_holes(2), ControlOptions{.max_valence = 7}));
    EXPECT_TRUE(check_reachable(plate_with_holes(1), ControlOptions{.max_valence = 6}));
    EXPECT_TRUE(check_reachable(punctured(plate_with_holes(3), {0}), ControlOptions{.max_valence = 6})) << "a boundary takes any";
}

TEST(ReachableBoundsTest, AFrozenBoundaryKeepsItsEdges) {
    expect_refused(square(4), {.max_size = 0.9, .freeze_boundary = true}, "max_size", "at least 1, the longest edge");
    EXPECT_TRUE(check_reachable(square(4), ControlOptions{.max_size = 1, .freeze_boundary = true}));
    EXPECT_TRUE(check_reachable(square(4), ControlOptions{.max_size = 0.9}));
    EXPECT_TRUE(check_reachable(cube(), ControlOptions{.max_size = 0.2, .freeze_boundary = true})) << "closed";
    SizingOptions sizing;
    sizing.max_size = 0.9;
    expect_refused(square(4), {.sizing = sizing, .freeze_boundary = true}, "sizing.max_size", "at least 1");
    const ExecutionContext context;
    const auto refused = improve(square(4), {.sizing = sizing, .freeze_boundary = true}, {}, context);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().field, "sizing.max_size");
}

}  // namespace
}  // namespace vsplit::test
