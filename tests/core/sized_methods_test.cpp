#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "method/flip_slivers.h"
#include "method/size_plan.h"
#include "spatial/surface_index.h"
#include "tests/core/meshes.h"
#include "vsplit/mesh/inspect.h"
#include "vsplit/method/control.h"
#include "vsplit/method/improve.h"
#include "vsplit/mrr/progressive_mesh.h"
#include "vsplit/quality/deviation.h"
#include "vsplit/quality/stretch.h"

namespace vsplit::test {
namespace {

TriangleMesh shown(const MethodResult& result) { return mesh_at(result.mrr, result.mrr.level_for(result.faces)); }

double longest_edge_in(const TriangleMesh& mesh, const SizeSphere& ball) {
    double longest = 0;
    for (const Triangle& t : mesh.faces) {
        const auto inside = [&](std::uint32_t v) { return (mesh.positions[v] - ball.center).norm() <= ball.radius; };
        if (std::none_of(t.begin(), t.end(), inside)) continue;
        longest = std::max(longest, face_size(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]));
    }
    return longest;
}

double mean_size(const TriangleMesh& mesh) {
    double sum = 0;
    for (const Triangle& t : mesh.faces) sum += face_size(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]);
    return sum / mesh.face_count();
}

const SizeSphere kBall{Vec3(1, 1, 1), 0.3, 0.08};

class Sized : public testing::TestWithParam<Mode> {};

TEST_P(Sized, ImproveKeepsToASphereAtEveryResolution) {
    ImproveOptions options;
    options.mode = GetParam();
    options.subdivision_size = 0.15;
    options.sizing.emplace().spheres = {kBall};
    const Expected<MethodResult> result = improve(cube(), options, {}, {});
    ASSERT_TRUE(result.has_value()) << result.error().message;
    EXPECT_TRUE(result->bounds_satisfied()) << result->violations.front().reason << " " << result->violations.front().worst;
    const TriangleMesh mesh = shown(*result);
    // A face that meets the ball may reach out of it, where a little more is allowed.
    EXPECT_LE(longest_edge_in(mesh, kBall), kBall.size * 1.21);
    EXPECT_GT(mean_size(mesh), 1.1 * kBall.size) << "elsewhere faces may be larger";
    const TriangleMesh coarsest = mesh_at(result->mrr, 0);
    EXPECT_LE(longest_edge_in(coarsest, kBall), kBall.size * 1.3) << "sizes bind at the coarsest resolution too";
}

TEST_P(Sized, ControlKeepsToAField) {
    const TriangleMesh source = icosphere(4);
    ControlOptions options;
    options.mode = GetParam();
    options.tolerance = 0.05;
    options.sizing.emplace();
    for (const Vec3& p : source.positions) options.sizing->field.push_back(p.z() > 0 ? 0.12 : 0.5);
    options.faces = 1200;
    const Expected<MethodResult> result = control(source, options, {}, {});
    ASSERT_TRUE(result.has_value()) << result.error().message;
    const TriangleMesh mesh = shown(*result);
    double above = 0, below = 0;
    for (const Triangle& t : mesh.faces) {
        const auto z = [&](int i) { return mesh.positions[t[i]].z(); };
        const double size = face_size(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]);
        if (std::min({z(0), z(1), z(2)}) > 0.05) above = std::max(above, size);
        if (std::max({z(0), z(1), z(2)}) < -0.5) below = std::max(below, size);
    }
    EXPECT_LE(above, 0.12 * 1.02);
    EXPECT_GT(below, 0.2);
}

INSTANTIATE_TEST_SUITE_P(Modes, Sized, testing::Values(Mode::kStrict, Mode::kExtended),
                         [](const auto& mode) { return mode.param == Mode::kStrict ? "strict" : "extended"; });

TEST(SizedTest, OversizedFacesAreThoseOfBruteForce) {
    const TriangleMesh source = icosphere(3);
    SizingOptions sizing;
    sizing.spheres = {{Vec3(0, 0, 1), 0.5, 0.1}};
    const Expected<SizePlan> plan = plan_sizes(source, sizing, {}, 1);
    ASSERT_TRUE(plan.has_value());
    const std::optional<Violation> violation = find_oversized(source, source, *plan);
    ASSERT_TRUE(violation.has_value());
    std::vector<std::uint32_t> expected;
    for (std::uint32_t f = 0; f < source.face_count(); ++f) {
        bool over = false;
        for (int i = 0; i < 3; ++i) {
            const std::uint32_t a = source.faces[f][i], b = source.faces[f][(i + 1) % 3];
            const double allowed = std::min(plan->field.vertex_sizes()[a], plan->field.vertex_sizes()[b]);
            over |= (source.positions[a] - source.positions[b]).norm() > allowed * (1 + 1e-9);
        }
        if (over) expected.push_back(f);
    }
    EXPECT_EQ(violation->elements, expected);
    EXPECT_EQ(violation->count, expected.size());
    EXPECT_GT(violation->worst, 1);
}

TEST(SizedTest, FromNothingFacesAreSmallerWhereTheSurfaceBends) {
    TriangleMesh ball = icosphere(5);
    for (Vec3& p : ball.positions) p *= 0.1;
    const TriangleMesh source = joined(ball, plate_with_holes(0), Vec3(3, 0, 0));
    ImproveOptions options;
    options.tolerance = 2e-3;
    const Expected<MethodResult> result = improve(source, options, {}, {});
    ASSERT_TRUE(result.has_value()) << result.error().message;
    double round = 0, flat = 0;
    int n_round = 0, n_flat = 0;
    const TriangleMesh mesh = shown(*result);
    for (const Triangle& t : mesh.faces) {
        const double size = face_size(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]);
        if (mesh.positions[t[0]].x() < 1.5) {
            round += size;
            ++n_round;
        } else {
            flat += size;
            ++n_flat;
        }
    }
    ASSERT_GT(n_round, 0);
    ASSERT_GT(n_flat, 0);
    EXPECT_LT(round / n_round, 0.9 * flat / n_flat);
}

TEST(FloorTest, TheMeanStretchEndsSimplificationInBothModes) {
    const TriangleMesh source = bumpy_sphere(5, 0.02, 3);
    for (const Mode mode : {Mode::kStrict, Mode::kExtended}) {
        ImproveOptions options;
        options.mode = mode;
        options.tolerance = 0.05;
        options.min_mean_stretch = 0;
        const Expected<MethodResult> free = improve(source, options, {}, {});
        options.min_mean_stretch = 0.84;
        const Expected<MethodResult> kept = improve(source, options, {}, {});
        ASSERT_TRUE(free.has_value() && kept.has_value());
        EXPECT_GT(kept->mrr.faces_min(), free->mrr.faces_min());
        EXPECT_GE(measure_quality(mesh_at(kept->mrr, 0)).stretch_mean, 0.82);
    }
}

TEST(FloorTest, NoFaceGetsUnderTheLeastStretchWhereNoneWas) {
    const TriangleMesh source = icosphere(4);
    const double before = measure_quality(source).stretch_min;
    ImproveOptions options;
    options.mode = Mode::kStrict;
    options.subdivision_size = 10;
    options.tolerance = 1;
    options.min_stretch = 0.5;
    ASSERT_GT(before, 0.5);
    const Expected<MethodResult> result = improve(source, options, {}, {});
    ASSERT_TRUE(result.has_value());
    EXPECT_LT(result->mrr.faces_min(), source.face_count() / 4);
    for (const std::size_t level : {std::size_t{0}, result->mrr.levels() / 2}) {
        EXPECT_GE(measure_quality(mesh_at(result->mrr, level)).stretch_min, 0.5);
    }
}

TEST(FlipSliversTest, FlatFansBecomeDelaunayAndNothingElseMoves) {
    TriangleMesh source = sliver_cylinder(64, 0.5);
    for (Vec3& p : source.positions) p.x() *= 3;  // or the caps' corners would lie on a circle, and any diagonals be Delaunay
    FeatureOptions features;
    features.angle = 20;
    const std::shared_ptr<const CreasedMesh> flipped = flip_slivers(source, features, 1e-9, {});
    ASSERT_NE(flipped, nullptr);
    EXPECT_EQ(flipped->mesh.positions, source.positions);
    EXPECT_EQ(flipped->mesh.face_count(), source.face_count());
    EXPECT_LE(flipped->moved, 1e-9);
    EXPECT_TRUE(require_closed_manifold(inspect(flipped->mesh)));
    EXPECT_NEAR(enclosed_volume(flipped->mesh), enclosed_volume(source), 1e-9);
    EXPECT_GT(measure_quality(flipped->mesh).stretch_mean, measure_quality(source).stretch_mean);
    const Expected<Deviation> deviation = measure_deviation(flipped->mesh, source, {}, {});
    ASSERT_TRUE(deviation.has_value());
    EXPECT_LE(deviation->max(), 1e-4);
}

TEST(FlipSliversTest, BoundariesAndCreasesStay) {
    const TriangleMesh source = punctured(plate_with_holes(1), {0});
    const std::shared_ptr<const CreasedMesh> flipped = flip_slivers(source, {}, 1e-9, {});
    if (!flipped) return;
    const MeshReport before = inspect(source), after = inspect(flipped->mesh);
    EXPECT_EQ(after.boundary_edges, before.boundary_edges);
    EXPECT_EQ(after.faces, before.faces);
    EXPECT_TRUE(require_manifold(after));
}

}  // namespace
}  // namespace vsplit::test
