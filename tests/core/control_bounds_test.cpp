#include "method/control_bounds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "tests/core/bound_count.h"
#include "tests/core/meshes.h"
#include "tests/core/polishing.h"
#include "tests/core/random.h"
#include "vsplit/io/read_mesh.h"
#include "vsplit/mesh/inspect.h"
#include "vsplit/method/control.h"
#include "vsplit/method/improve.h"
#include "vsplit/mrr/mrr_file.h"
#include "vsplit/mrr/progressive_mesh.h"

namespace vsplit::test {
namespace {

MethodResult controlled(const TriangleMesh& mesh, const ControlOptions& options, unsigned threads = 0) {
    const ExecutionContext context({}, threads);
    auto result = control(mesh, options, {}, context);
    EXPECT_TRUE(result) << result.error().message;
    return result ? std::move(*result) : MethodResult{};
}

TriangleMesh level_of(const MethodResult& result, std::size_t level) { return mesh_at(result.mrr, level); }
TriangleMesh shown(const MethodResult& result) { return level_of(result, result.mrr.level_for(result.faces)); }

/// Bounds that faces of a good mesh keep.
ControlOptions all_bounds() {
    ControlOptions options;
    options.min_stretch = 0.3;
    options.max_valence = 8;
    options.min_angle = 20;
    options.max_angle = 125;
    options.max_aspect_ratio = 2.8;
    return options;
}

/// What is reported is what breaks: no more, no less, and in the same words.
void expect_true_report(const MethodResult& result) {
    const ControlOptions& used = std::get<ControlOptions>(result.options);
    const TriangleMesh mesh = shown(result);
    // Between the two slacks lies rounding.
    const auto surely = broken_bounds(mesh, used, 1e-9), perhaps = broken_bounds(mesh, used, -1e-9);
    EXPECT_LE(surely.size(), result.violations.size());
    EXPECT_TRUE(surely.empty() || !result.bounds_satisfied());
    for (const Violation& violation : result.violations) {
        const auto some = surely.find(violation.bound), most = perhaps.find(violation.bound);
        ASSERT_TRUE(most != perhaps.end()) << violation.bound;
        EXPECT_EQ(violation.elements.size(), std::min<std::size_t>(violation.count, Violation::kMostElements));
        if (some != surely.end() && violation.count <= Violation::kMostElements) {
            EXPECT_TRUE(
                std::includes(violation.elements.begin(), violation.elements.end(), some->second.begin(), some->second.end()))
                << violation.bound;
        }
        EXPECT_TRUE(std::includes(most->second.begin(), most->second.end(), violation.elements.begin(), violation.elements.end()))
            << violation.bound;
        EXPECT_FALSE(violation.reason.empty());
    }
}

void expect_all_hold(const TriangleMesh& mesh, const ControlOptions& used, std::size_t level) {
    for (const auto& [bound, elements] : broken_bounds(mesh, used, 1e-9)) {
        ADD_FAILURE() << bound << " broken by " << elements.size() << " at level " << level;
    }
}

TEST(ControlBoundsTest, EveryLevelOfAMeshThatKeepsItsBoundsKeepsThem) {
    for (const Mode mode : {Mode::kStrict, Mode::kExtended}) {
        for (const TriangleMesh& source : {icosphere(3), torus(40, 16), jittered_cube(8, 0.1, 4)}) {
            ControlOptions options = all_bounds();
            options.tolerance = 0.05;
            options.mode = mode;
            options.faces = source.face_count();
            const MethodResult result = controlled(source, options);
            EXPECT_TRUE(result.bounds_satisfied()) << source.face_count();
            expect_true_report(result);
            ASSERT_GT(result.mrr.levels(), 100U);
            const std::size_t last = result.mrr.level_for(result.faces);
            for (std::size_t level = 0; level <= last; level += 1 + last / 12) {
                expect_all_hold(level_of(result, level), std::get<ControlOptions>(result.options), level);
            }
        }
    }
}

TEST(ControlBoundsTest, ALeastSizeIsReachedByCollapses) {
    const TriangleMesh source = icosphere(3);  // edges of about 0.15
    for (const Mode mode : {Mode::kStrict, Mode::kExtended}) {
        ControlOptions options{.tolerance = 0.05, .min_size = 0.25, .mode = mode};
        const MethodResult result = controlled(source, options);
        expect_true_report(result);
        if (mode == Mode::kStrict) continue;  // which only comes near
        EXPECT_TRUE(result.bounds_satisfied());
        EXPECT_LT(result.faces, source.face_count()) << "a coarser resolution was taken";
        EXPECT_GT(result.faces, 100U);
    }
}

TEST(ControlBoundsTest, WithFacesGivenTheResolutionStaysWithinATenth) {
    const TriangleMesh source = icosphere(3);
    const ControlOptions options{.tolerance = 0.05, .min_size = 0.25, .faces = source.face_count()};
    const MethodResult result = controlled(source, options);
    EXPECT_FALSE(result.bounds_satisfied());
    EXPECT_GE(result.faces, source.face_count() * 9 / 10 - 2);
    expect_true_report(result);
    EXPECT_NE(result.violations.at(0).reason.find("fewer faces"), std::string::npos);
}

TEST(ControlBoundsTest, ReportsOfRandomBoundsAreTrue) {
    Random random(17);
    const std::vector<TriangleMesh> sources{icosphere(2), bumpy_sphere(3, 0.02, 1), plate_with_holes(2), sliver_cylinder(40, 4),
                                            torus(24, 10)};
    int kept = 0, broken = 0;
    for (int n = 0; n < 30; ++n) {
        const TriangleMesh& source = sources[random.below(static_cast<std::uint32_t>(sources.size()))];
        const auto maybe = [&](double low, double high) {
            return random.below(2) == 0 ? std::optional<double>(random.uniform(low, high)) : std::nullopt;
        };
        const double diagonal = bounding_box(source).diagonal();
        ControlOptions options{.subdivisions = random.below(2), .min_stretch = random.uniform(0, 0.5)};
        options.tolerance = random.uniform(0.001, 0.02) * diagonal;
        options.max_size = maybe(0.1 * diagonal, 0.4 * diagonal);
        options.min_size = maybe(0.001 * diagonal, 0.05 * diagonal);
        options.min_angle = maybe(2, 30);
        options.max_angle = maybe(110, 175);
        options.max_aspect_ratio = maybe(1.8, 8);
        if (random.below(2) == 0) options.max_valence = 7 + random.below(4);
        if (random.below(2) == 0) options.faces = 100 + random.below(1500);
        options.mode = random.below(2) == 0 ? Mode::kStrict : Mode::kExtended;
        SCOPED_TRACE(n);
        const MethodResult result = controlled(source, options);
        expect_true_report(result);
        ++(result.bounds_satisfied() ? kept : broken);
        const MeshReport after = inspect(shown(result)), before = inspect(source);
        EXPECT_TRUE(after.closed);
        EXPECT_EQ(after.genus, before.genus);
        EXPECT_EQ(after.components, before.components);
    }
    EXPECT_GE(kept, 8);
    EXPECT_GE(broken, 3);
}

TEST(ControlBoundsTest, SameBytesForAnyNumberOfThreads) {
    ControlOptions options = all_bounds();
    for (const TriangleMesh& source : {sliver_cylinder(60, 3), bumpy_sphere(3, 0.02, 5)}) {
        for (const Mode mode : {Mode::kStrict, Mode::kExtended}) {
            options.mode = mode;
            const MethodResult one = controlled(source, options, 1), two = controlled(source, options, 2);
            EXPECT_EQ(one.mrr, two.mrr);
            EXPECT_EQ(one.faces, two.faces);
            ASSERT_EQ(one.violations.size(), two.violations.size());
            for (std::size_t n = 0; n < one.violations.size(); ++n) {
                EXPECT_EQ(one.violations[n].elements, two.violations[n].elements);
                EXPECT_EQ(one.violations[n].worst, two.violations[n].worst);
            }
        }
    }
}

TEST(ControlBoundsTest, WhatTheGeometryForcesIsListedWithItsReason) {
    // A needle of a wedge: its edge of 10 degrees stays whatever is done.
    TriangleMesh wedge;
    wedge.positions = {Vec3(0, 0, 0), Vec3(1, -0.0875, 0), Vec3(1, 0.0875, 0),
                       Vec3(0, 0, 1), Vec3(1, -0.0875, 1), Vec3(1, 0.0875, 1)};
    wedge.faces = {{0, 2, 1}, {3, 4, 5}, {0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}};
    const MethodResult result = controlled(wedge, {.subdivisions = 2, .tolerance = 0.001, .min_angle = 15});
    ASSERT_EQ(result.violations.size(), 1U);
    EXPECT_EQ(result.violations[0].bound, "min_angle");
    EXPECT_NEAR(result.violations[0].worst, 10, 0.1);
    EXPECT_NE(result.violations[0].reason.find("lie between creases"), std::string::npos) << result.violations[0].reason;
    expect_true_report(result);
}

TEST(ControlBoundsTest, ListsTenThousandAndCountsAll) {
    const ControlOptions options{.min_size = 1};
    const auto found = find_violations(icosphere(5), options);  // 20,480 faces
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].count, 20480U);
    ASSERT_EQ(found[0].elements.size(), 10000U);
    EXPECT_EQ(found[0].elements.back(), 9999U);
}

TEST(ControlBoundsTest, ABoundThatIsMetExactlyHolds) {
    const TriangleMesh mesh = cube();  // right-angled faces with two equal sides
    EXPECT_TRUE(
        find_violations(mesh, {.min_angle = 45, .max_angle = 90, .max_aspect_ratio = std::sqrt(2.0), .min_size = std::sqrt(2.0)})
            .empty());
    EXPECT_EQ(find_violations(mesh, {.min_angle = 45.001}).at(0).count, 12U);
    EXPECT_EQ(find_violations(mesh, {.max_angle = 89.999}).at(0).count, 12U);
    EXPECT_EQ(find_violations(mesh, {.max_aspect_ratio = 1.414}).at(0).count, 12U);
    EXPECT_EQ(find_violations(mesh, {.min_size = 1.415}).at(0).count, 12U);
    EXPECT_NEAR(find_violations(mesh, {.min_angle = 50}).at(0).worst, 45, 1e-9);
    EXPECT_NEAR(find_violations(mesh, {.max_angle = 80}).at(0).worst, 90, 1e-9);
}

struct Refused {
    ControlOptions options;
    std::string field;
    std::string accepted;
};

TEST(ControlBoundsTest, ContradictionsAreRefusedNamingFieldAndWhatIsAccepted) {
    const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
    SizingOptions sphere, box, field, sizes;
    sphere.spheres.push_back({Vec3::Zero(), 1, 0.5});
    box.boxes.push_back({Vec3::Zero(), Vec3(1, 1, 1), 0.5});
    field.field = {0, 3, 0.5};
    sizes.max_size = 0.5;
    const std::vector<Refused> all{
        {{.min_angle = 60}, "min_angle", "less than 60 degrees, since the angles"},
        {{.min_angle = 0}, "min_angle", "more than 0"},
        {{.min_angle = nan}, "min_angle", "more than 0"},
        {{.max_angle = 60}, "max_angle", "more than 60"},
        {{.max_angle = 180}, "max_angle", "less than 180"},
        {{.max_angle = nan}, "max_angle", "less than 180"},
        {{.max_aspect_ratio = 0.99}, "max_aspect_ratio", "1 or more"},
        {{.max_aspect_ratio = inf}, "max_aspect_ratio", "finite"},
        {{.max_aspect_ratio = nan}, "max_aspect_ratio", "1 or more"},
        {{.min_size = 0}, "min_size", "a positive finite length"},
        {{.min_size = inf}, "min_size", "a positive finite length"},
        {{.min_size = nan}, "min_size", "a positive finite length"},
        {{.max_size = 1, .min_size = 1.5}, "min_size", "at most max_size, which is 1"},
        {{.min_size = 1, .sizing = sphere}, "min_size", "at most the size of sizing.spheres[0], which is 0.5"},
        {{.min_size = 1, .sizing = box}, "min_size", "at most the size of sizing.boxes[0], which is 0.5"},
        {{.min_size = 1, .sizing = field}, "min_size", "at most sizing.field[2], which is 0.5"},
        {{.min_size = 1, .sizing = sizes}, "min_size", "at most sizing.max_size, which is 0.5"},
    };
    for (const Refused& refused : all) {
        const Status status = check_options(refused.options);
        ASSERT_FALSE(status) << refused.field << ' ' << refused.accepted;
        EXPECT_EQ(status.error().cause, Cause::kInvalidOption);
        EXPECT_EQ(status.error().field, refused.field) << status.error().message;
        EXPECT_NE(status.error().message.find(refused.accepted), std::string::npos) << status.error().message;
    }
    EXPECT_TRUE(
        check_options(ControlOptions{.max_size = 1, .min_angle = 59, .max_angle = 61, .max_aspect_ratio = 1, .min_size = 1}));
    sphere.min_size = 1;  // then no size is less, whatever the sphere asks for
    const Status clamped_size = check_options(ControlOptions{.min_size = 1, .sizing = sphere});
    EXPECT_TRUE(clamped_size || clamped_size.error().field != "min_size");
}

class ControlBoundsRealMesh : public testing::TestWithParam<std::filesystem::path> {};

TEST_P(ControlBoundsRealMesh, ReportIsTrue) {
    auto read = read_mesh_file(GetParam(), {});
    ASSERT_TRUE(read);
    const TriangleMesh& mesh = read->mesh;
    ControlOptions options = all_bounds();
    options.subdivisions = 0;
    options.max_aspect_ratio = 4;
    options.min_size = 0.001 * bounding_box(mesh).diagonal();
    expect_true_report(controlled(mesh, options));
}

std::string param_name(const testing::TestParamInfo<std::filesystem::path>& info) { return test_name(info.param); }

INSTANTIATE_TEST_SUITE_P(Own, ControlBoundsRealMesh,
                         testing::Values(data_file("bracket.stl"), data_file("combined.stl"), data_file("scan.ply")), param_name);

}  // namespace
}  // namespace vsplit::test
