#include "vsplit/quality/element_quality.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>

#include "tests/core/meshes.h"

namespace vsplit {
namespace {

TEST(ElementQualityTest, IsWhatVtksVerdictSays) {
    std::ifstream golden(test::data_file("quality/verdict.txt"));  // made by verdict.py beside it
    int triangles = 0;
    const auto expect = [](double ours, double theirs) { EXPECT_NEAR(ours, theirs, 1e-6 * std::abs(theirs)); };
    for (Vec3 a, b, c; golden >> a.x() >> a.y() >> a.z() >> b.x() >> b.y() >> b.z() >> c.x() >> c.y() >> c.z(); ++triangles) {
        double min_angle, max_angle, edge_ratio, aspect_ratio, radius_ratio, scaled_jacobian;
        ASSERT_TRUE(golden >> min_angle >> max_angle >> edge_ratio >> aspect_ratio >> radius_ratio >> scaled_jacobian);
        const ElementQuality q = element_quality(a, b, c);
        expect(q.min_angle, min_angle);
        expect(q.max_angle, max_angle);
        expect(q.edge_ratio, edge_ratio);
        expect(q.aspect_ratio, aspect_ratio);
        expect(q.radius_ratio, radius_ratio);
        expect(q.scaled_jacobian, scaled_jacobian);
    }
    EXPECT_EQ(triangles, 60);
}

TEST(ElementQualityTest, KnownTriangles) {
    const ElementQuality good = element_quality({0, 0, 0}, {2, 0, 0}, {1, std::sqrt(3.0), 0});
    for (const double one : {good.stretch, good.edge_ratio, good.aspect_ratio, good.radius_ratio, good.scaled_jacobian})
        EXPECT_NEAR(one, 1, 1e-12);
    EXPECT_NEAR(good.min_angle, 60, 1e-9);
    EXPECT_NEAR(good.skew, 0, 1e-6);
    // Right-angled with equal legs: at the right angle the median is perpendicular to the middles; at the others tan = 2.
    EXPECT_NEAR(element_quality({0, 0, 0}, {1, 0, 0}, {0, 1, 0}).skew, 90 - 180 / M_PI * std::atan(2.0), 1e-9);
    const ElementQuality flat = element_quality({0, 0, 0}, {1, 0, 0}, {2, 0, 0});
    EXPECT_EQ(flat.stretch, 0);
    EXPECT_EQ(flat.max_angle, 180);
    EXPECT_TRUE(std::isinf(flat.aspect_ratio));
    EXPECT_EQ(flat.skew, 90);
    EXPECT_TRUE(std::isinf(element_quality({0, 0, 0}, {0, 0, 0}, {1, 0, 0}).edge_ratio));
}

TEST(ElementQualityTest, ProfilesCountEachFaceOnce) {
    for (const auto& [name, mesh] : test::small_meshes()) {
        for (const QualityProfile profile : {QualityProfile::kStretch02, QualityProfile::kVerdict, QualityProfile::kOptistruct}) {
            const ProfileReport report = check_profile(mesh, profile, 7);
            EXPECT_EQ(report.passed + report.warned + report.failed, mesh.face_count()) << name;
            EXPECT_EQ(report.worst.size(), std::min(7U, report.warned + report.failed)) << name;
            for (const CriterionReport& criterion : report.criteria) EXPECT_LE(criterion.failed, report.failed) << name;
            EXPECT_EQ(*profile_by_name(profile_name(profile)), profile);
        }
    }
    EXPECT_EQ(check_profile(test::icosphere(2), QualityProfile::kVerdict, 5).passed, 320U);
    // Sides 10 long and 0.157 wide: edge ratio 63.7, angles of 0.9 degrees; OptiStruct's limits are 50 and 3.
    const ProfileReport slivers = check_profile(test::sliver_cylinder(40, 10), QualityProfile::kOptistruct, 5);
    EXPECT_EQ(slivers.criteria[0].name, "edge_ratio");
    EXPECT_EQ(slivers.criteria[0].warned, 80U);
    EXPECT_GE(slivers.failed, 80U);
    EXPECT_TRUE(slivers.criteria[0].upper);
    EXPECT_EQ(slivers.criteria[0].warn_limit, 50);
    EXPECT_EQ(slivers.criteria[0].fail_limit, 500);
    EXPECT_FALSE(slivers.criteria[2].upper);
    EXPECT_EQ(slivers.criteria[2].warn_limit, 15);
    EXPECT_EQ(slivers.criteria[2].fail_limit, 3);
    EXPECT_EQ(profile_by_name("nastran").error().field, "profile");
}

/// "< 15", or "-" where there are no warnings.
std::string limit_text(const CriterionReport& criterion, double limit) {
    std::ostringstream text;
    text << (criterion.upper ? "> " : "< ") << limit;
    return text.str();
}

TEST(ElementQualityTest, TheTableInTheDocumentsIsRight) {
    std::ifstream file(test::data_file("../../docs/elements.md"));
    const std::string table((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    for (const QualityProfile profile : {QualityProfile::kStretch02, QualityProfile::kVerdict, QualityProfile::kOptistruct}) {
        std::size_t at = table.find("\n| `" + std::string(profile_name(profile)) + '`');
        ASSERT_NE(at, std::string::npos) << profile_name(profile);
        for (const CriterionReport& criterion : check_profile(test::cube(), profile, 0).criteria) {
            const std::string warning =
                criterion.warn_limit == criterion.fail_limit ? "-" : limit_text(criterion, criterion.warn_limit);
            const std::string row =
                "| `" + criterion.name + "` | " + warning + " | " + limit_text(criterion, criterion.fail_limit) + " |\n";
            at = table.find(row, at);
            ASSERT_NE(at, std::string::npos) << profile_name(profile) << " lacks " << row;
        }
    }
}

}  // namespace
}  // namespace vsplit
