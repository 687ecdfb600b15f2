#include "vsplit/mrr/position_grid.h"

#include <gtest/gtest.h>

#include "mrr/grid_codes.h"
#include "tests/core/edited_mrr.h"
#include "tests/core/meshes.h"
#include "tests/core/random.h"

namespace vsplit::test {
namespace {

Vec3 random_point(Random& random, double size) {
    return {size * (random.uniform(0, 1) - 0.5), size * (random.uniform(0, 1) - 0.5), size * (random.uniform(0, 1) - 0.5)};
}

TEST(PositionGridTest, Float32IsTheNearestFloatBitForBit) {
    Random random(1);
    const PositionGrid grid = PositionGrid::float32();
    for (int n = 0; n < 1000; ++n) {
        const Vec3 point = random_point(random, n % 2 == 0 ? 1e6 : 1e-3);
        const Vec3 snapped = grid.snap(point);
        for (int axis = 0; axis < 3; ++axis) {
            const volatile float rounded = static_cast<float>(point[axis]);
            ASSERT_EQ(snapped[axis], static_cast<double>(rounded));  // and not the double itself
            ASSERT_LE(std::abs(snapped[axis] - point[axis]), grid.max_error(std::abs(point[axis])));
        }
    }
    EXPECT_TRUE(std::signbit(grid.snap(Vec3(-0.0, 0, 0)).x()));
}

TEST(PositionGridTest, CodesKeepTheOrderAndComeBack) {
    const Float32Codes codes{PositionGrid::float32()};
    const std::vector<double> ascending = {-1e15, -1, -1e-30, -0.0, 0.0, 1e-40, 0.5, 1, 1e15};
    for (std::size_t n = 0; n + 1 < ascending.size(); ++n) {
        EXPECT_LT(codes.code(ascending[n], 0), codes.code(ascending[n + 1], 0));
        const volatile float rounded = static_cast<float>(ascending[n]);
        EXPECT_EQ(std::bit_cast<std::uint64_t>(codes.value(codes.code(ascending[n], 0), 0)),
                  std::bit_cast<std::uint64_t>(static_cast<double>(rounded)));
    }
    EXPECT_FALSE(codes.holds(0xFFFFFFFFU));  // a NaN
    EXPECT_FALSE(codes.holds(codes.code(1e16, 0)));
    EXPECT_TRUE(codes.holds(codes.code(-1e15, 0)));
}

TEST(PositionGridTest, QuantisedKeepsTheErrorItStates) {
    const MultiresMesh mrr = edited_mrr(bumpy_sphere(3, 0.02, 5), 60, 200).mrr;
    for (const std::uint32_t bits : {10U, 14U, 16U, 24U}) {
        const PositionGrid grid = *PositionGrid::over(mrr, {RecordEncoding::kQuantised, bits});
        const MultiresMesh rounded = on_grid(mrr, grid);
        std::vector<Vec3> before, after;
        double largest = 0;
        for_each_position(mrr, [&](const Vec3& p) {
            before.push_back(p);
            largest = std::max(largest, p.cwiseAbs().maxCoeff());
        });
        for_each_position(rounded, [&after](const Vec3& p) { after.push_back(p); });
        double worst = 0;
        for (std::size_t n = 0; n < before.size(); ++n) worst = std::max(worst, (before[n] - after[n]).cwiseAbs().maxCoeff());
        EXPECT_LE(worst, grid.max_error(largest)) << bits;
        EXPECT_GT(worst, grid.max_error(largest) * 0.9) << bits;  // the bound is no idle one
        EXPECT_EQ(rounded.records.kinds().size(), mrr.records.kinds().size());
    }
}

TEST(PositionGridTest, RefusesWhatIsNoGrid) {
    for (const std::uint32_t bits : {1U, 9U, 25U, 64U})
        EXPECT_EQ(check_encoding({RecordEncoding::kQuantised, bits}).error().field, "quantisation_bits");
    EXPECT_FALSE(check_encoding({RecordEncoding::kFloat32, 14}));
    EXPECT_EQ(check_encoding({RecordEncoding::kQuantised, 0})->bits, kUsualBits);
    EXPECT_FALSE(PositionGrid::quantised(14, Vec3::Zero(), 0));
    EXPECT_FALSE(PositionGrid::quantised(14, Vec3::Zero(), -1));
    EXPECT_FALSE(PositionGrid::quantised(14, Vec3::Zero(), 0x1p-1023)) << "it has no reciprocal";
    EXPECT_TRUE(PositionGrid::quantised(14, Vec3::Zero(), 0x1p-1022));
    EXPECT_FALSE(PositionGrid::quantised(24, Vec3::Zero(), 1e9));
    EXPECT_FALSE(PositionGrid::quantised(14, Vec3(0, NAN, 0), 1));
    EXPECT_TRUE(PositionGrid::quantised(14, Vec3(1, 2, 3), 0.5));
}

TEST(PositionGridTest, APointHasAGridToo) {
    MultiresMesh mrr;
    mrr.base.positions = {Vec3(3, 3, 3), Vec3(3, 3, 3)};
    const auto grid = PositionGrid::over(mrr, {RecordEncoding::kQuantised, 14});
    ASSERT_TRUE(grid) << grid.error().message;
    EXPECT_EQ(grid->snap(Vec3(3, 3, 3)), Vec3(3, 3, 3));
}

}  // namespace
}  // namespace vsplit::test
