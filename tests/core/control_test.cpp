#include "vsplit/method/control.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/core/meshes.h"
#include "vsplit/io/read_mesh.h"
#include "vsplit/mesh/inspect.h"
#include "vsplit/method/improve.h"
#include "vsplit/mrr/progressive_mesh.h"
#include "vsplit/quality/stretch.h"

namespace vsplit {
namespace {

MethodResult controlled(const TriangleMesh& mesh, const ControlOptions& options) {
    const ExecutionContext context;
    auto result = control(mesh, options, {}, context);
    EXPECT_TRUE(result) << result.error().message;
    return std::move(*result);
}

TriangleMesh improved_at_default(const TriangleMesh& mesh) {
    const ExecutionContext context;
    const auto result = improve(mesh, {}, {}, context);
    EXPECT_TRUE(result) << result.error().message;
    return mesh_at(result->mrr, result->mrr.level_for(result->faces));
}

std::uint32_t count_of(const std::vector<Violation>& violations, const std::string& bound) {
    for (const Violation& v : violations) {
        if (v.bound == bound) return v.count;
    }
    return 0;
}

/// Counts every broken bound without the product's help and compares.
void expect_report_is_true(const MethodResult& result, const ControlOptions& bounds) {
    const TriangleMesh mesh = mesh_at(result.mrr, result.mrr.level_for(result.faces));
    std::uint32_t thin = 0;
    std::uint32_t large = 0;
    std::vector<std::uint32_t> valence(mesh.positions.size(), 0);
    for (const Triangle& t : mesh.faces) {
        const Vec3& a = mesh.positions[t[0]];
        const Vec3& b = mesh.positions[t[1]];
        const Vec3& c = mesh.positions[t[2]];
        thin += stretch(a, b, c) < bounds.min_stretch.value_or(kStretchFloor) ? 1 : 0;
        large += bounds.max_size && std::max({(a - b).norm(), (b - c).norm(), (c - a).norm()}) > *bounds.max_size ? 1 : 0;
        for (const std::uint32_t v : t) ++valence[v];
    }
    std::uint32_t crowded = 0;
    for (const std::uint32_t n : valence) crowded += bounds.max_valence && n > *bounds.max_valence ? 1 : 0;
    EXPECT_EQ(count_of(result.violations, "min_stretch"), thin);
    EXPECT_EQ(count_of(result.violations, "max_size"), large);
    EXPECT_EQ(count_of(result.violations, "max_valence"), crowded);
    EXPECT_EQ(result.bounds_satisfied(), thin + large + crowded == 0);
    for (const Violation& v : result.violations) EXPECT_FALSE(v.reason.empty());
}

/// Faces under 0.2 that creases force which meet at a sharp angle: with other faces in the corner there may be one more.
std::uint32_t sharp_corners(const MethodResult& result) {
    for (const Slivers& slivers : result.slivers) {
        if (slivers.cause == SliverCause::kSharpCorner) return slivers.count;
    }
    return 0;
}

class ControlRealMesh : public testing::TestWithParam<std::filesystem::path> {};

TEST_P(ControlRealMesh, ReportsEveryBoundTrulyAndKeepsTopology) {
    auto read = read_mesh_file(GetParam(), {});
    ASSERT_TRUE(read) << read.error().message;
    const TriangleMesh mesh = improved_at_default(read->mesh);
    ControlOptions options;
    options.max_valence = 12;
    options.max_size = 0.05 * bounding_box(mesh).diagonal();
    const MethodResult result = controlled(mesh, options);
    expect_report_is_true(result, options);
    EXPECT_EQ(count_of(result.violations, "max_size"), 0U) << "what is too large can always be subdivided";
    const MeshReport before = inspect(read->mesh);
    const MeshReport after = inspect(result.mrr.base);
    EXPECT_TRUE(after.closed);
    EXPECT_EQ(after.components, before.components);
    EXPECT_EQ(after.genus, before.genus);
    EXPECT_LE(result.quality.faces_below_02 - sharp_corners(result), measure_quality(mesh).faces_below_02);
}

std::string param_name(const testing::TestParamInfo<std::filesystem::path>& info) { return test::test_name(info.param); }

INSTANTIATE_TEST_SUITE_P(Own, ControlRealMesh, testing::ValuesIn(test::own_closed_meshes()), param_name);
INSTANTIATE_TEST_SUITE_P(Shared, ControlRealMesh, testing::ValuesIn(test::shared_closed_meshes(false)), param_name);
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(ControlRealMesh);

TEST(ControlTest, ADefaultDeviationHoldsWhereTheFirstAttemptGoesBeyondIt) {
    const auto read = read_mesh_file(test::data_file("crankshaft.stl"), {});
    ASSERT_TRUE(read) << read.error().message;
    const MethodResult result = controlled(read->mesh, {});
    const auto& used = std::get<ControlOptions>(result.options);
    EXPECT_EQ(*used.max_deviation, 2 * *used.tolerance) << "it has not given way";
    EXPECT_LE(*result.quality.deviation_max, *used.max_deviation);
    EXPECT_LE(*result.quality.crease_deviation_max, *used.max_deviation);
}

TEST(ControlTest, AllBoundsHoldOnEveryFaceOfAMeshThatMeetsThem) {
    ControlOptions options;
    options.min_stretch = 0.5;
    options.max_size = 0.5;
    options.max_valence = 8;
    options.tolerance = 0.2;
    options.faces = 400;
    const MethodResult result = controlled(test::icosphere(3), options);
    EXPECT_TRUE(result.bounds_satisfied());
    EXPECT_GT(result.mrr.levels(), 500U);
    expect_report_is_true(result, options);
    for (std::size_t level = 0; level <= result.mrr.levels(); level += 97) {
        EXPECT_TRUE(find_violations(mesh_at(result.mrr, level), default_options(test::icosphere(3), options)).empty()) << level;
    }
}

TEST(ControlTest, FirstPhaseMendsViolators) {
    const TriangleMesh rough = improved_at_default(test::sliver_cylinder(80, 6));
    ControlOptions options;
    options.faces = 200;
    options.mode = Mode::kStrict;  // the phases are the paper's
    const MethodResult result = controlled(rough, options);
    EXPECT_TRUE(result.bounds_satisfied()) << result.violations.front().count;
    EXPECT_GE(result.quality.stretch_min, 0.2);
}

TEST(ControlTest, FacesOverTheSizeAreSubdivided) {
    ControlOptions options;
    options.subdivisions = 0;
    options.max_size = 0.4;
    options.faces = 4'000'000;
    const MethodResult result = controlled(test::cube(), options);
    EXPECT_EQ(count_of(result.violations, "max_size"), 0U);
    EXPECT_LE(result.quality.size_max, 0.4);
    EXPECT_GT(result.faces, test::cube().face_count());
}

TEST(ControlTest, AnImpossibleBoundIsReportedNotRefused) {
    ControlOptions options;
    options.min_stretch = 1;  // no cube has equilateral faces only
    const MethodResult result = controlled(test::cube(), options);
    EXPECT_FALSE(result.bounds_satisfied());
    expect_report_is_true(result, options);
}

TEST(ControlTest, DefaultsAreFilledIn) {
    const TriangleMesh mesh = test::icosphere(2);
    const ControlOptions used = default_options(mesh, {});
    EXPECT_EQ(used.subdivisions, 1U);
    EXPECT_EQ(used.min_stretch, kStretchFloor);
    EXPECT_EQ(used.faces, mesh.face_count());
    EXPECT_FALSE(used.max_size.has_value());
    EXPECT_FALSE(used.max_valence.has_value());
    EXPECT_EQ(used.mode, Mode::kExtended);
    EXPECT_DOUBLE_EQ(*used.max_deviation, 2 * *used.tolerance);
    EXPECT_FALSE(default_options(mesh, {.mode = Mode::kStrict}).max_deviation.has_value());
}

TEST(ControlTest, RefusesWhatItCannotDoAndSaysWhy) {
    const auto cause = [](const ControlOptions& options, const std::string& field) {
        const ExecutionContext context;
        const auto result = control(test::cube(), options, {.max_faces = 10000}, context);
        EXPECT_FALSE(result);
        EXPECT_EQ(result.error().field, field);
        return result.error().cause;
    };
    EXPECT_EQ(cause({.subdivisions = 13}, "subdivisions"), Cause::kInvalidOption);
    EXPECT_EQ(cause({.subdivisions = 6}, "subdivisions"), Cause::kLimitExceeded);
    EXPECT_EQ(cause({.min_stretch = 1.5}, "min_stretch"), Cause::kInvalidOption);
    EXPECT_EQ(cause({.min_stretch = std::numeric_limits<double>::quiet_NaN()}, "min_stretch"), Cause::kInvalidOption);
    EXPECT_EQ(cause({.max_size = 0}, "max_size"), Cause::kInvalidOption);
    EXPECT_EQ(cause({.max_size = 1e-6}, "max_size"), Cause::kLimitExceeded);
    EXPECT_EQ(cause({.max_valence = 5}, "max_valence"), Cause::kInvalidOption);
    EXPECT_EQ(cause({.max_deviation = 1, .mode = Mode::kStrict}, "max_deviation"), Cause::kUnsupported);
    EXPECT_EQ(cause({.max_deviation = -1}, "max_deviation"), Cause::kInvalidOption);
}

}  // namespace
}  // namespace vsplit
