#include "method/mend_hubs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/core/bound_count.h"
#include "tests/core/meshes.h"
#include "tests/core/sampled_deviation.h"
#include "vsplit/mesh/inspect.h"
#include "vsplit/method/control.h"
#include "vsplit/mrr/progressive_mesh.h"

namespace vsplit::test {
namespace {

/// A cone of `segments` faces on a fan of as many, radius 1: two hubs.
TriangleMesh cone(std::uint32_t segments, double height) {
    TriangleMesh mesh;
    mesh.positions = {Vec3(0, 0, height), Vec3(0, 0, 0)};
    for (std::uint32_t n = 0; n < segments; ++n) {
        const double angle = 2 * 3.141592653589793 * n / segments;
        mesh.positions.emplace_back(std::cos(angle), std::sin(angle), 0);
        const std::uint32_t a = 2 + n, b = 2 + (n + 1) % segments;
        mesh.faces.push_back({0, a, b});
        mesh.faces.push_back({1, b, a});
    }
    return mesh;
}

ControlOptions bounded(const TriangleMesh& mesh, std::uint32_t max_valence) {
    return default_options(mesh, {.max_valence = max_valence});
}

std::size_t hubs(const TriangleMesh& mesh, std::uint32_t max_valence) {
    return broken_bounds(mesh, {.max_valence = max_valence}, 0)["max_valence"].size();
}

TEST(MendHubsTest, FansGetAsFewSpokesAsAskedWithinTheTolerance) {
    const ExecutionContext context;
    for (const TriangleMesh& mesh : {cone(200, 1), cone(37, 0.3), sliver_cylinder(80, 3), sliver_cylinder(33, 1)}) {
        for (const std::uint32_t max_valence : {8U, 9U, 12U}) {
            ASSERT_GT(hubs(mesh, max_valence), 0U);
            const ControlOptions options = bounded(mesh, max_valence);
            const auto mended = mend_hubs(mesh, options, context);
            ASSERT_TRUE(mended);
            EXPECT_EQ(hubs(mended->mesh, max_valence), 0U) << mesh.face_count() << " faces, bound " << max_valence;
            EXPECT_TRUE(inspect(mended->mesh).closed);
            EXPECT_EQ(inspect(mended->mesh).genus, 0U);
            EXPECT_LE(mended->mesh.face_count(), 4 * mesh.face_count());
            // Each flip keeps to the tolerance; some lie upon others.
            EXPECT_LE(sampled_deviation(mended->mesh, mesh, 4), 1.5 * *options.tolerance);
            EXPECT_LE(sampled_deviation(mesh, mended->mesh, 4), 1.5 * *options.tolerance);
        }
    }
}

TEST(MendHubsTest, AMeshWithoutHubsIsLeftAlone) {
    const ExecutionContext context;
    EXPECT_FALSE(mend_hubs(icosphere(2), bounded(icosphere(2), 6), context));
    EXPECT_FALSE(mend_hubs(cone(200, 1), default_options(cone(200, 1), {}), context));
    EXPECT_FALSE(mend_hubs(cone(8, 1), bounded(cone(8, 1), 8), context));
}

TEST(MendHubsTest, CreasesStay) {
    const ExecutionContext context;
    const TriangleMesh mesh = sliver_cylinder(64, 2);
    const ControlOptions options = bounded(mesh, 8);
    const auto mended = mend_hubs(mesh, options, context);
    ASSERT_TRUE(mended);
    const auto length = [](const TriangleMesh& of, const std::vector<SharpEdge>& creases) {
        double sum = 0;
        for (const SharpEdge& edge : creases) sum += (of.positions[edge.a] - of.positions[edge.b]).norm();
        return sum;
    };
    const double before = length(mesh, find_creases(mesh, face_normals(mesh), feature_options(options)));
    EXPECT_GT(before, 12);
    EXPECT_NEAR(length(mended->mesh, mended->creases), before, 1e-9);
}

TEST(MendHubsTest, ControlOfAConeKeepsItsBoundsInBothModes) {
    const ExecutionContext context;
    const TriangleMesh mesh = cone(200, 1);
    for (const Mode mode : {Mode::kStrict, Mode::kExtended}) {
        const auto result = control(mesh, {.min_stretch = 0.15, .max_valence = 8, .mode = mode}, {}, context);
        ASSERT_TRUE(result);
        EXPECT_TRUE(result->bounds_satisfied()) << result->violations.front().bound << ' ' << result->violations.front().count;
        for (std::size_t level = 0; level <= result->mrr.levels(); level += 1 + result->mrr.levels() / 7) {
            EXPECT_EQ(hubs(mesh_at(result->mrr, level), 8), 0U) << level;
        }
    }
}

/// Faces (0, n, n + 1) over an angle, in degrees, on a cone of that height; open but where they go all around.
TriangleMesh open_fan(std::uint32_t segments, double angle, double height) {
    TriangleMesh mesh;
    mesh.positions = {Vec3(0, 0, height)};
    const bool around = angle == 360;
    for (std::uint32_t n = 0; n <= segments - (around ? 1 : 0); ++n) {
        const double at = angle * 3.141592653589793 / 180 * n / segments;
        mesh.positions.emplace_back(std::cos(at), std::sin(at), 0);
    }
    for (std::uint32_t n = 0; n < segments; ++n) mesh.faces.push_back({0, 1 + n, around && n + 1 == segments ? 1 : 2 + n});
    return mesh;
}

TEST(MendHubsTest, HubsOfOpenMeshesAreMendedWithinThemAndOnTheirBoundary) {
    const ExecutionContext context;
    for (const TriangleMesh& mesh : {open_fan(200, 360, 1), open_fan(120, 180, 0), open_fan(90, 270, 0.2), open_fan(64, 40, 0)}) {
        SCOPED_TRACE(mesh.face_count());
        ASSERT_FALSE(inspect(mesh).closed);
        ASSERT_GT(hubs(mesh, 8), 0U);
        const ControlOptions options = bounded(mesh, 8);
        const auto mended = mend_hubs(mesh, options, context);
        ASSERT_TRUE(mended);
        EXPECT_EQ(hubs(mended->mesh, 8), 0U);
        const MeshReport before = inspect(mesh), after = inspect(mended->mesh);
        EXPECT_TRUE(require_manifold(after));
        EXPECT_EQ(after.boundary_edges, before.boundary_edges) << "none is cut";
        EXPECT_LE(sampled_deviation(mended->mesh, mesh, 4), 1.5 * *options.tolerance);
        EXPECT_LE(sampled_deviation(mesh, mended->mesh, 4), 1.5 * *options.tolerance);
        const auto result = control(mesh, {.min_stretch = 0.05, .max_valence = 8}, {}, context);
        ASSERT_TRUE(result);
        for (std::size_t level = 0; level <= result->mrr.levels(); level += 1 + result->mrr.levels() / 7) {
            EXPECT_EQ(hubs(mesh_at(result->mrr, level), 8), 0U) << level;
        }
    }
}

TEST(MendHubsTest, AFieldOfSizesGoesOnWhereHubsAreCut) {
    const ExecutionContext context;
    const TriangleMesh mesh = cone(200, 1);
    SizingOptions sizing;
    sizing.field.assign(mesh.vertex_count(), 0.4);
    sizing.field[0] = 0.1;  // at the tip
    const auto result = control(mesh, {.min_stretch = 0.05, .max_valence = 8, .sizing = sizing}, {}, context);
    ASSERT_TRUE(result);
    const TriangleMesh shown = mesh_at(result->mrr, result->mrr.level_for(result->faces));
    EXPECT_EQ(hubs(shown, 8), 0U);
    for (const Violation& violation : result->violations) EXPECT_NE(violation.bound, "max_valence");
    double longest_at_tip = 0, longest = 0;
    for (const Triangle& t : shown.faces) {
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec3 &a = shown.positions[t[i]], &b = shown.positions[t[(i + 1) % 3]];
            longest = std::max(longest, (a - b).norm());
            if (std::max(a.z(), b.z()) > 0.98) longest_at_tip = std::max(longest_at_tip, (a - b).norm());
        }
    }
    EXPECT_LE(longest, 0.4 * 1.05);
    EXPECT_LE(longest_at_tip, 0.13);
}

TEST(MendHubsTest, ObeysACancel) {
    ExecutionContext context;
    context.cancel();
    const auto result = control(cone(200, 1), {.max_valence = 8}, {}, context);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().cause, Cause::kCancelled);
}

}  // namespace
}  // namespace vsplit::test
