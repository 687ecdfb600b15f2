#include "simplify/border.h"

#include <gtest/gtest.h>

#include "mesh/cap_boundaries.h"
#include "tests/core/meshes.h"

namespace vsplit::test {
namespace {

TEST(BorderTest, AClosedMeshHoldsNothing) {
    const Border border(cube(), 0, {}, true);
    EXPECT_TRUE(border.empty());
    for (std::uint32_t v = 0; v < 8; ++v) {
        EXPECT_FALSE(border.is_ghost(v));
        EXPECT_EQ(border.hold(v), Hold::kFree);
        EXPECT_EQ(border.ghost_beside(v), kNone);
        EXPECT_TRUE(border.may_join(v, (v + 1) % 8));
    }
}

TEST(BorderTest, SaysWhoMayJoinWhom) {
    const CappedMesh capped = cap_manifold(holed_square(4, 1));  // ghosts 0 and 1, then 25 vertices, five a row
    ASSERT_EQ(capped.ghosts, 2U);
    constexpr std::uint32_t kRim = 2, kNextOnRim = 3, kHole = 2 + 11, kNextOnHole = 2 + 12, kInside = 2 + 8;
    const Border border(capped.mesh, capped.ghosts, {kRim}, false);
    EXPECT_EQ(border.hold(0), Hold::kGhost);
    EXPECT_EQ(border.hold(kRim), Hold::kCorner);
    EXPECT_EQ(border.hold(kNextOnRim), Hold::kAlong);
    EXPECT_EQ(border.hold(kInside), Hold::kFree);
    EXPECT_NE(border.ghost_beside(kRim), border.ghost_beside(kHole));
    EXPECT_FALSE(border.may_join(0, kRim));
    EXPECT_FALSE(border.may_join(0, 1));
    EXPECT_FALSE(border.may_join(kRim, kHole)) << "two boundaries";
    EXPECT_TRUE(border.may_join(kRim, kNextOnRim));
    EXPECT_TRUE(border.may_join(kHole, kNextOnHole));
    EXPECT_TRUE(border.may_join(kInside, kHole));
    EXPECT_TRUE(border.may_join(kInside, kInside + 5));

    const Border frozen(capped.mesh, capped.ghosts, {kRim}, true);
    EXPECT_FALSE(frozen.may_join(kRim, kNextOnRim));
    EXPECT_TRUE(frozen.may_join(kRim, kInside));
}

TEST(BorderTest, WhoeverIsJoinedIsHeldAsTheStrongerWas) {
    const CappedMesh capped = cap_manifold(square(4));
    constexpr std::uint32_t kCorner = 1, kAlong = 2, kInside = 1 + 6;
    Border border(capped.mesh, capped.ghosts, {kCorner}, false);
    border.join(kInside, kAlong);
    EXPECT_EQ(border.hold(kInside), Hold::kAlong);
    EXPECT_EQ(border.ghost_beside(kInside), 0U);
    border.join(kInside, kCorner);
    EXPECT_EQ(border.hold(kInside), Hold::kCorner);
}

}  // namespace
}  // namespace vsplit::test
