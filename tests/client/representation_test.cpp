#include "wire/representation.h"

#include <gtest/gtest.h>

#include "tests/core/meshes.h"
#include "vsplit/method/control.h"

namespace vsplit::wire {
namespace {

MethodResult a_result(const MethodOptions& options) {
    MethodResult result;
    result.options = options;
    result.mrr.base = test::tetrahedron();
    for (int split = 0; split < 10; ++split) result.mrr.records.push_back(VertexSplit{});
    result.faces = 12;
    result.quality.faces = 12;
    result.quality.stretch_mean = 0.75;
    result.elapsed = std::chrono::duration<double>(2.5);
    return result;
}

v1::Representation described(const char* id, const char* source, std::uint32_t faces, const MethodResult& result) {
    return describe(id, source, faces, result, extent_of(result.mrr));
}

TEST(RepresentationTest, DescribesAnImprovement) {
    ImproveOptions options;
    options.tolerance = 0.5;
    options.mode = Mode::kStrict;
    const v1::Representation made = described("r1", "r0", 99, a_result(options));
    EXPECT_EQ(made.id(), "r1");
    EXPECT_EQ(made.method(), v1::IMPROVE);
    EXPECT_EQ(made.source().representation(), "r0");
    EXPECT_EQ(made.source().faces(), 99U);
    EXPECT_EQ(made.improve_options().tolerance(), 0.5);
    EXPECT_FALSE(made.has_control_options());
    EXPECT_EQ(made.faces_min(), 4U);
    EXPECT_EQ(made.faces_max(), 24U);
    EXPECT_EQ(made.faces(), 12U);
    EXPECT_EQ(made.quality().stretch_mean(), 0.75);
    EXPECT_TRUE(made.bounds_satisfied());
    EXPECT_EQ(made.mode(), v1::STRICT);
    EXPECT_EQ(made.elapsed().seconds(), 2);
    EXPECT_EQ(made.elapsed().nanos(), 500'000'000);
    EXPECT_EQ(made.records().splits(), 10U);
    EXPECT_EQ(made.records().moves(), 0U);
}

TEST(RepresentationTest, DescribesWhatControlCouldNotMend) {
    MethodResult result = a_result(ControlOptions());
    result.violations.push_back({"min_stretch", 0.2, 0.1, 3, {1, 2, 3}, "no collapse helps"});
    const v1::Representation made = described("r2", "", 12, result);
    EXPECT_EQ(made.method(), v1::CONTROL);
    EXPECT_FALSE(made.bounds_satisfied());
    ASSERT_EQ(made.violations_size(), 1);
    EXPECT_EQ(made.violations(0).reason(), "no collapse helps");
}

TEST(RepresentationTest, TellsWhatForcesSliversAtItsOwnResolution) {
    MethodResult result = a_result(ImproveOptions());
    result.quality.deviation_max = 0.25;
    result.quality.crease_deviation_max = 0.125;
    result.slivers.push_back({SliverCause::kNarrowStrip, 83, 0.012, 0.03, {4, 5}, "83 faces lie between creases"});
    v1::Representation made = described("r5", "", 12, result);
    EXPECT_EQ(made.quality().crease_deviation_max(), 0.125);
    ASSERT_EQ(made.slivers_size(), 1);
    EXPECT_EQ(made.slivers(0).cause(), "NARROW_STRIP");
    EXPECT_EQ(made.slivers(0).count(), 83U);
    EXPECT_EQ(made.slivers(0).least(), 0.012);
    EXPECT_EQ(made.slivers(0).most(), 0.03);
    EXPECT_EQ(made.slivers(0).elements_size(), 2);
    EXPECT_EQ(made.slivers(0).message(), "83 faces lie between creases");

    describe_resolution(test::icosphere(1), made);
    EXPECT_EQ(made.slivers_size(), 0) << "those faces are not there";
    EXPECT_FALSE(made.quality().has_crease_deviation_max());
}

TEST(RepresentationTest, LeavesOutWhatMayBeAsLargeAsTheMesh) {
    ImproveOptions options;
    options.feature_detection = FeatureDetection::kNormalVoting;
    options.marked_edges = {1, 2};
    options.regions = {1, 1, 2, 2};
    options.sizing.emplace().field = {1, 2, 3, 4};
    options.sizing->chord_error = 0.5;
    const v1::Representation made = described("r4", "", 4, a_result(options));
    EXPECT_EQ(made.improve_options().feature_detection(), v1::NORMAL_VOTING);
    EXPECT_EQ(made.improve_options().marked_edges_size(), 0);
    EXPECT_EQ(made.improve_options().regions_size(), 0);
    EXPECT_EQ(made.improve_options().sizing().field_size(), 0);
    EXPECT_EQ(made.improve_options().sizing().chord_error(), 0.5);
}

TEST(RepresentationTest, FollowsToAnotherResolution) {
    ControlOptions options;
    options.min_stretch = 0.5;
    MethodResult result = a_result(options);
    result.violations.push_back({"min_stretch", 0.5, 0.4, 1, {0}, "the method's reason"});
    v1::Representation made = described("r3", "", 12, result);

    describe_resolution(test::icosphere(1), made);
    EXPECT_EQ(made.faces(), 80U);
    EXPECT_EQ(made.quality().faces(), 80U);
    EXPECT_TRUE(made.bounds_satisfied());
    EXPECT_TRUE(made.violations().empty());

    v1::Representation again = described("r3", "", 12, result);
    const TriangleMesh slivers = test::sliver_cylinder(16, 10);
    describe_resolution(slivers, again);
    EXPECT_FALSE(again.bounds_satisfied());
    ASSERT_EQ(again.violations_size(), 1);
    EXPECT_EQ(again.violations(0).count(), find_violations(slivers, options).at(0).count);
    EXPECT_EQ(again.violations(0).reason(), "the method's reason");
}

}  // namespace
}  // namespace vsplit::wire
