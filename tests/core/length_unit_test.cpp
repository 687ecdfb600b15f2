#include "vsplit/mesh/length_unit.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/core/random.h"

namespace vsplit::test {
namespace {

double converted(double length, LengthUnit from, LengthUnit to) {
    std::vector<Vec3> positions{{length, -length, 0}};
    convert_lengths(positions, from, to);
    EXPECT_EQ(positions[0].y(), -positions[0].x());
    EXPECT_EQ(positions[0].z(), 0);
    return positions[0].x();
}

TEST(LengthUnitTest, SymbolsAreReadBack) {
    for (const LengthUnit unit : length_units()) {
        const Expected<LengthUnit> found = unit_by_symbol(unit_symbol(unit));
        ASSERT_TRUE(found);
        EXPECT_EQ(*found, unit);
    }
    const Expected<LengthUnit> unknown = unit_by_symbol("yd");
    ASSERT_FALSE(unknown);
    EXPECT_EQ(unknown.error().cause, Cause::kInvalidOption);
    EXPECT_EQ(unknown.error().field, "unit");
    EXPECT_NE(unknown.error().message.find("um, mm, cm, m, in, ft"), std::string::npos) << unknown.error().message;
}

TEST(LengthUnitTest, MetresByDefinition) {
    EXPECT_EQ(metres_in(LengthUnit::kMicrometre), 1e-6);
    EXPECT_EQ(metres_in(LengthUnit::kMillimetre), 1e-3);
    EXPECT_EQ(metres_in(LengthUnit::kCentimetre), 1e-2);
    EXPECT_EQ(metres_in(LengthUnit::kMetre), 1);
    EXPECT_EQ(metres_in(LengthUnit::kInch), 0.0254);
    EXPECT_EQ(metres_in(LengthUnit::kFoot), 0.3048);
}

TEST(LengthUnitTest, WholeFactorsRoundOnce) {
    EXPECT_EQ(converted(1, LengthUnit::kInch, LengthUnit::kMillimetre), 25.4);
    EXPECT_EQ(converted(25.4, LengthUnit::kMillimetre, LengthUnit::kInch), 1);
    EXPECT_EQ(converted(5, LengthUnit::kFoot, LengthUnit::kInch), 60);
    EXPECT_EQ(converted(3, LengthUnit::kMillimetre, LengthUnit::kMetre), 0.003) << "3 * 0.001 would be another number";
    EXPECT_EQ(converted(0.07, LengthUnit::kMetre, LengthUnit::kMicrometre), 70000);
}

TEST(LengthUnitTest, ThereAndBackIsTheSameWithinRounding) {
    Random random(7);
    for (const LengthUnit from : length_units()) {
        for (const LengthUnit to : length_units()) {
            const double length = random.uniform(1e-3, 1e3);
            EXPECT_NEAR(converted(converted(length, from, to), to, from), length, 1e-15 * length);
            EXPECT_NEAR(converted(length, from, to) * metres_in(to), length * metres_in(from), 1e-15 * length);
            EXPECT_TRUE(from != to || converted(length, from, to) == length);
        }
    }
}

TEST(LengthUnitTest, FileAndUserAgreeOrAreBothNamed) {
    using Unit = std::optional<LengthUnit>;
    EXPECT_EQ(*agreed_unit({}, {}), Unit());
    EXPECT_EQ(*agreed_unit(LengthUnit::kInch, {}), Unit(LengthUnit::kInch));
    EXPECT_EQ(*agreed_unit({}, LengthUnit::kMetre), Unit(LengthUnit::kMetre));
    EXPECT_EQ(*agreed_unit(LengthUnit::kFoot, LengthUnit::kFoot), Unit(LengthUnit::kFoot));
    const Expected<Unit> contrary = agreed_unit(LengthUnit::kInch, LengthUnit::kMillimetre);
    ASSERT_FALSE(contrary);
    EXPECT_EQ(contrary.error().cause, Cause::kInvalidOption);
    EXPECT_EQ(contrary.error().field, "unit");
    EXPECT_NE(contrary.error().message.find("in in"), std::string::npos) << contrary.error().message;
    EXPECT_NE(contrary.error().message.find("mm is stated"), std::string::npos) << contrary.error().message;
}

}  // namespace
}  // namespace vsplit::test
