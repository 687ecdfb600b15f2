#include "vsplit/method/improve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "tests/core/meshes.h"
#include "vsplit/io/read_mesh.h"
#include "vsplit/mesh/inspect.h"
#include "vsplit/mrr/progressive_mesh.h"

namespace vsplit {
namespace {

TriangleMesh read(const std::filesystem::path& path) {
    auto result = read_mesh_file(path, {});
    EXPECT_TRUE(result) << path << ": " << result.error().message;
    return std::move(result->mesh);
}

/// The shared mesh of that name, or nothing where the collection is not on this machine.
std::optional<TriangleMesh> shared_mesh(const std::string& stem) {
    for (const auto& path : test::shared_closed_meshes()) {
        if (path.stem() == stem) return read(path);
    }
    GTEST_LOG_(INFO) << stem << " is not on this machine; nothing checked against it";
    return std::nullopt;
}

MethodResult improved(const TriangleMesh& mesh, const ImproveOptions& options) {
    const ExecutionContext context;
    auto result = improve(mesh, options, {}, context);
    EXPECT_TRUE(result) << result.error().message;
    return std::move(*result);
}

void expect_topology_kept(const TriangleMesh& source, const MultiresMesh& mrr) {
    const MeshReport before = inspect(source);
    for (const std::size_t level : {std::size_t{0}, mrr.levels() / 2, mrr.levels()}) {
        const MeshReport after = inspect(mesh_at(mrr, level));
        EXPECT_TRUE(after.closed) << "level " << level;
        EXPECT_EQ(after.components, before.components) << "level " << level;
        EXPECT_EQ(after.genus, before.genus) << "level " << level;
    }
}

class ImproveRealMesh : public testing::TestWithParam<std::filesystem::path> {};

TEST_P(ImproveRealMesh, WithDefaultsKeepsTopologyAndBettersShape) {
    const TriangleMesh mesh = read(GetParam());
    const MethodResult result = improved(mesh, {});
    expect_topology_kept(mesh, result.mrr);
    EXPECT_EQ(result.faces_subdivided, result.mrr.faces_max());
    EXPECT_TRUE(result.bounds_satisfied());
    const double before = measure_quality(mesh).stretch_mean;
    const bool needles =
        GetParam().stem() == "combined_generic_twin";  // walls thinner than the coordinates' steps: no shape to gain
    if (before < 0.7 && !needles) {
        EXPECT_GT(result.quality.stretch_mean, before);
    }
    EXPECT_EQ(std::get<ImproveOptions>(result.options).faces, result.faces) << "the resolution chosen is one that exists";
}

std::string param_name(const testing::TestParamInfo<std::filesystem::path>& info) { return test::test_name(info.param); }

INSTANTIATE_TEST_SUITE_P(Own, ImproveRealMesh, testing::ValuesIn(test::own_closed_meshes()), param_name);
INSTANTIATE_TEST_SUITE_P(Shared, ImproveRealMesh, testing::ValuesIn(test::shared_closed_meshes(false)), param_name);
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(ImproveRealMesh);

TEST(ImproveTest, ReachesThePapersQualityOnASliveredPart) {
    const auto mesh = shared_mesh("cad_fanuc_lrmate200id_link3");
    if (!mesh) return;
    ImproveOptions options;
    options.subdivision_size = 0.0025;
    options.tolerance = 0.000255;
    options.faces = 10000;
    options.mode = Mode::kStrict;
    const MethodResult result = improved(*mesh, options);
    EXPECT_EQ(result.faces, 10000U);
    EXPECT_GE(result.quality.stretch_mean, 0.68);
}

TEST(ImproveTest, ReachesThePapersQualityOnAFiniteElementMesh) {
    const auto mesh = shared_mesh("fe_sfepy_wheelset_surface");
    if (!mesh) return;
    ImproveOptions options;
    options.subdivision_size = 0.025;
    options.tolerance = 0.0025;
    options.faces = 4000;
    options.mode = Mode::kStrict;
    const MethodResult result = improved(*mesh, options);
    EXPECT_EQ(result.faces, 4000U);
    EXPECT_GE(result.quality.stretch_mean, 0.78);
}

TEST(ImproveTest, TheSameInputGivesTheSameBits) {
    const TriangleMesh mesh = test::sliver_cylinder(60, 8);
    const ImproveOptions options{.subdivision_size = 0.2};
    const MethodResult first = improved(mesh, options);
    const MethodResult second = improved(mesh, options);
    EXPECT_EQ(first.mrr, second.mrr);
    EXPECT_EQ(first.faces, second.faces);
}

TEST(ImproveTest, DefaultsAreFilledInAndKept) {
    const TriangleMesh mesh = test::cube();
    const double diagonal = bounding_box(mesh).diagonal();
    const ImproveOptions used = default_options(mesh, {}, {});
    EXPECT_EQ(used.mode, Mode::kExtended);
    EXPECT_DOUBLE_EQ(*used.tolerance, 1e-3 * diagonal);
    EXPECT_DOUBLE_EQ(*used.max_deviation, 2e-3 * diagonal);
    EXPECT_DOUBLE_EQ(*used.subdivision_size, 1.5e-2 * diagonal);
    const ImproveOptions strict = default_options(mesh, {.mode = Mode::kStrict}, {});
    EXPECT_EQ(strict.mode, Mode::kStrict);
    EXPECT_DOUBLE_EQ(*strict.tolerance, 1e-3 * diagonal);
    EXPECT_FALSE(strict.max_deviation.has_value());
    EXPECT_DOUBLE_EQ(*strict.subdivision_size, 1e-2 * diagonal);
    ImproveOptions asked;
    asked.tolerance = 0.5;
    asked.faces = 77;
    EXPECT_EQ(*default_options(mesh, asked, {}).tolerance, 0.5);
    EXPECT_EQ(*default_options(mesh, asked, {}).faces, 77U);
}

TEST(ImproveTest, AResolutionOutOfRangeGivesTheNearest) {
    ImproveOptions options{.subdivision_size = 0.1};
    options.faces = 4'000'000'000U;
    const MethodResult fine = improved(test::torus(30, 20), options);
    EXPECT_EQ(fine.faces, fine.mrr.faces_max());
    options.faces = 4;
    const MethodResult coarse = improved(test::torus(30, 20), options);
    EXPECT_EQ(coarse.faces, coarse.mrr.faces_min());
}

TEST(ImproveTest, RefusesWhatItCannotDoAndSaysWhy) {
    const auto cause = [](const TriangleMesh& mesh, const ImproveOptions& options, const std::string& field) {
        const ExecutionContext context;
        const auto result = improve(mesh, options, {.max_faces = 100'000}, context);
        EXPECT_FALSE(result);
        EXPECT_EQ(result.error().field, field);
        EXPECT_FALSE(result.error().message.empty());
        return result.error().cause;
    };
    TriangleMesh fin = test::cube();
    fin.positions.emplace_back(0.5, 0.5, 9);
    fin.faces.push_back({fin.faces[0][0], fin.faces[0][1], 8});
    EXPECT_EQ(cause(fin, {}, ""), Cause::kNonManifold);
    EXPECT_EQ(cause({}, {}, ""), Cause::kEmptyInput);
    const TriangleMesh mesh = test::cube();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(cause(mesh, {.subdivision_size = -1}, "subdivision_size"), Cause::kInvalidOption);
    EXPECT_EQ(cause(mesh, {.subdivision_size = 1e-9}, "subdivision_size"), Cause::kLimitExceeded);
    EXPECT_EQ(cause(test::sliver_cylinder(500, 1e6), {.subdivision_size = 1e-3}, "subdivision_size"), Cause::kLimitExceeded);
    EXPECT_EQ(cause(mesh, {.tolerance = 0}, "tolerance"), Cause::kInvalidOption);
    EXPECT_EQ(cause(mesh, {.tolerance = nan}, "tolerance"), Cause::kInvalidOption);
    EXPECT_EQ(cause(mesh, {.max_deviation = 1, .mode = Mode::kStrict}, "max_deviation"), Cause::kUnsupported);
    EXPECT_EQ(cause(mesh, {.max_deviation = 0}, "max_deviation"), Cause::kInvalidOption);
    EXPECT_EQ(cause(mesh, {.max_deviation = nan}, "max_deviation"), Cause::kInvalidOption);
    EXPECT_EQ(cause(mesh, {.feature_angle = 181}, "feature_angle"), Cause::kInvalidOption);
    EXPECT_EQ(cause(mesh, {.feature_weight = -0.1}, "feature_weight"), Cause::kInvalidOption);
    EXPECT_EQ(cause(mesh, {.faces = 3}, "faces"), Cause::kInvalidOption);
    EXPECT_EQ(cause(mesh, {.faces = 100, .faces_min = 200}, "faces_min"), Cause::kInvalidOption);
}

TEST(ImproveTest, RefusesTwoFacesOnTheSameVertices) {
    TriangleMesh pillow;
    pillow.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    pillow.faces = {{0, 1, 2}, {0, 2, 1}};
    const auto result = improve(pillow, {}, {}, ExecutionContext());
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().cause, Cause::kNonManifold);
    EXPECT_NE(result.error().message.find("same three vertices"), std::string::npos) << result.error().message;
}

TEST(ImproveTest, WorksAtTheLargestCoordinates) {
    TriangleMesh mesh = test::cube();
    for (Vec3& p : mesh.positions) p = (p - Vec3::Constant(0.5)) * 2e15;
    for (const Mode mode : {Mode::kStrict, Mode::kExtended}) {
        ImproveOptions options;
        options.mode = mode;
        options.subdivision_size = 4e14;
        expect_topology_kept(mesh, improved(mesh, options).mrr);
    }
}

TEST(ImproveTest, AHubOfManyEdgesCostsNoMoreThanItsFaces) {
    // Two apexes over a ring: each collapse of the ring has both in its neighbourhood.
    constexpr std::uint32_t kRing = 20'000;
    TriangleMesh mesh;
    mesh.positions = {{0, 0, 1}, {0, 0, -1}};
    for (std::uint32_t i = 0; i < kRing; ++i) {
        const double angle = 2 * 3.141592653589793 * i / kRing;
        mesh.positions.emplace_back(std::cos(angle), std::sin(angle), 0);
        const std::uint32_t here = 2 + i, after = 2 + (i + 1) % kRing;
        mesh.faces.push_back({0, here, after});
        mesh.faces.push_back({1, after, here});
    }
    ImproveOptions options;
    options.mode = Mode::kStrict;
    options.subdivision_size = 3;
    const MethodResult result = improved(mesh, options);
    EXPECT_LT(result.mrr.faces_min(), kRing);
}

}  // namespace
}  // namespace vsplit
