#include "simplify/fan_shape.h"

#include <gtest/gtest.h>

#include <cmath>

#include "simplify/fan.h"
#include "tests/core/random.h"
#include "vsplit/quality/stretch.h"

namespace vsplit::test {
namespace {

/// A ring around the origin, some of them with points that fall together or lie on one line, and normals that are met or not.
Fan random_fan(Random& random, std::uint32_t faces) {
    Fan fan;
    const double flat = random.below(2) == 0 ? 1.0 : 0.01, radius = std::pow(10.0, random.uniform(-4, 4));
    for (std::uint32_t t = 0; t < faces; ++t) {
        const double angle = 2 * std::acos(-1.0) * t / faces;
        Vec3 at = Vec3(std::cos(angle), flat * std::sin(angle), random.uniform(-0.3, 0.3)) * radius * random.uniform(0.5, 1.5);
        if (t > 0 && random.below(16) == 0) at = fan.ring(t - 1);
        const auto tilt = static_cast<float>(random.uniform(-2, 2));
        fan.put(t, t, at, t, Eigen::Vector3f(tilt, 0, 1).normalized());
    }
    fan.close(faces);
    return fan;
}

/// The shape from its definition, a face at a time.
FanShape by_hand(const Fan& fan, const Vec3& apex) {
    FanShape shape{2, 0, 0, false};
    for (std::size_t t = 0; t < fan.size(); ++t) {
        const Vec3 left = fan.ring(t) - apex, right = fan.ring(t + 1) - apex;
        const Vec3 across(left.y() * right.z() - left.z() * right.y(), left.z() * right.x() - left.x() * right.z(),
                          left.x() * right.y() - left.y() * right.x());
        const auto length = [](const Vec3& v) { return std::sqrt(v.x() * v.x() + v.y() * v.y() + v.z() * v.z()); };
        const Vec3 side = fan.ring(t + 1) - fan.ring(t), normal = fan.old_normal(t);
        const double area = length(across), a = length(left), b = length(side), c = length(right);
        const double longest = std::max({a, b, c});
        const double stretch = std::sqrt(12.0) * area / ((a + b + c) * longest);
        EXPECT_EQ(fan.stretch(t), longest > 0 ? stretch : 0) << t;
        EXPECT_EQ(fan.face_size(t), longest) << t;
        EXPECT_EQ(fan.spoke(t), a) << t;
        shape.stretch_min = std::min(shape.stretch_min, fan.stretch(t));
        shape.stretch_sum += fan.stretch(t);
        shape.size_max = std::max(shape.size_max, longest);
        const double along = across.x() * normal.x() + across.y() * normal.y() + across.z() * normal.z();
        shape.folds |= !(kLeastTurnCosine * area <= along);
    }
    shape.folds |= !(shape.stretch_min > 0);
    return shape;
}

class FanShapeTest : public testing::TestWithParam<std::int64_t> {
protected:
    void SetUp() override { use_simd_path(GetParam()); }
    void TearDown() override { use_simd_path(0); }
};

TEST_P(FanShapeTest, HasTheBitsOfTheDefinition) {
    Random random(17);
    int folded = 0, whole = 0;
    for (int round = 0; round < 60; ++round) {
        for (std::uint32_t faces = 1; faces <= Fan::kCapacity; ++faces) {
            Fan fan = random_fan(random, faces);
            const double away = round % 3 == 0 ? 1e-3 : 0.2;
            for (const Vec3& way : {Vec3(0, 0, 0), Vec3(away, 0, 0), Vec3(0, away, away)}) {
                const Vec3 apex = way * fan.ring(0).norm();
                const FanShape shape = fan.shape_at(apex);
                const FanShape expected = by_hand(fan, apex);
                ASSERT_EQ(shape.stretch_min, expected.stretch_min) << faces;
                ASSERT_EQ(shape.stretch_sum, expected.stretch_sum) << faces;
                ASSERT_EQ(shape.size_max, expected.size_max) << faces;
                ASSERT_EQ(shape.folds, expected.folds) << faces;
                ++(shape.folds ? folded : whole);
            }
        }
    }
    EXPECT_GT(folded, 100);
    EXPECT_GT(whole, 100);
}

INSTANTIATE_TEST_SUITE_P(EveryKindOfVector, FanShapeTest, testing::ValuesIn(simd_paths()),
                         [](const auto& path) { return std::string(simd_path_name(path.param)); });

}  // namespace
}  // namespace vsplit::test
