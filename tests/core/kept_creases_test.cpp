#include "quality/kept_creases.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "spatial/shapes.h"
#include "tests/core/meshes.h"
#include "vsplit/features/creases.h"
#include "vsplit/io/read_mesh.h"
#include "vsplit/method/improve.h"
#include "vsplit/mrr/progressive_mesh.h"
#include "vsplit/subdivide/subdivide.h"

namespace vsplit::test {
namespace {

std::vector<SharpEdge> creases_of(const TriangleMesh& mesh, const FeatureOptions& options = {}) {
    return find_creases(mesh, face_normals(mesh), options);
}

std::optional<DirectedDeviation> measured(const TriangleMesh& result, const TriangleMesh& source,
                                          const std::vector<SharpEdge>& creases, double angle = 20) {
    const auto deviation = measure_kept_creases(result, source, creases, angle, {}, ExecutionContext());
    EXPECT_TRUE(deviation) << deviation.error().message;
    return deviation ? *deviation : std::nullopt;
}

/// From points of the creases to the nearest edge of the result that bends by more than `angle`, each against each.
double sampled(const TriangleMesh& result, const TriangleMesh& source, const std::vector<SharpEdge>& creases, double angle) {
    const std::vector<SharpEdge> to = find_sharp_edges(result, face_normals(result), {.angle = angle});
    double most = 0;
    for (const SharpEdge& crease : creases) {
        for (int i = 0; i <= 4; ++i) {
            const Vec3 p = source.positions[crease.a] + i / 4.0 * (source.positions[crease.b] - source.positions[crease.a]);
            double least = std::numeric_limits<double>::infinity();
            for (const SharpEdge& e : to) {
                const SegmentShape segment{{result.positions[e.a], result.positions[e.b]}};
                least = std::min(least, segment.closest(p).squared_distance);
            }
            most = std::max(most, std::sqrt(least));
        }
    }
    return most;
}

TEST(KeptCreasesTest, ImproveReportsTheDistanceOfTheSourcesCreases) {
    const auto bracket = read_mesh_file(data_file("bracket.stl"), {});
    ASSERT_TRUE(bracket);
    const TriangleMesh& source = bracket->mesh;
    const Expected<MethodResult> result =
        improve(source, {.subdivision_size = 8, .tolerance = 0.4, .faces = 5000}, {}, ExecutionContext());
    ASSERT_TRUE(result);
    ASSERT_TRUE(result->quality.crease_deviation_max.has_value());
    const TriangleMesh mesh = mesh_at(result->mrr, result->mrr.level_for(result->faces));
    const double seen = sampled(mesh, source, creases_of(source), 20);
    EXPECT_GT(seen, 0);
    EXPECT_LE(seen, *result->quality.crease_deviation_max * (1 + 1e-9));
    EXPECT_LE(*result->quality.crease_deviation_max, measured(mesh, source, creases_of(source))->lower * 1.02 + 1e-4)
        << "no more than the error promised over a distance that is attained";

    const Expected<MethodResult> smooth = improve(icosphere(3), {}, {}, ExecutionContext());
    ASSERT_TRUE(smooth);
    EXPECT_FALSE(smooth->quality.crease_deviation_max.has_value()) << "no creases";
    const Expected<MethodResult> strict = improve(cube(), {.mode = Mode::kStrict}, {}, ExecutionContext());
    ASSERT_TRUE(strict);
    EXPECT_FALSE(strict->quality.crease_deviation_max.has_value());
}

TEST(KeptCreasesTest, ABentCreaseIsNearBendsOnly) {
    const auto roof = [](double ridge) {
        TriangleMesh mesh = square(8);
        for (Vec3& p : mesh.positions) p.z() = -std::abs(p.x() - ridge);
        return mesh;
    };
    const TriangleMesh source = roof(4);
    std::vector<SharpEdge> ridge;
    for (const SharpEdge& crease : creases_of(source)) {
        if (source.positions[crease.a].x() == 4 && source.positions[crease.b].x() == 4) ridge.push_back(crease);
    }
    ASSERT_EQ(ridge.size(), 8U);
    EXPECT_LE(measured(source, source, ridge)->upper, 2e-4);
    EXPECT_NEAR(measured(roof(5), source, ridge)->lower, 1, 1e-9) << "its old edges are there still, and flat";
    EXPECT_NEAR(measured(square(8), source, ridge)->lower, 4, 0.08) << "only the boundary is left";
    EXPECT_EQ(measured(icosphere(2), source, ridge)->upper, std::numeric_limits<double>::infinity());
}

TEST(KeptCreasesTest, AFlatCreaseIsNearAnyEdge) {
    const TriangleMesh source = square(4);
    FeatureOptions options;
    for (const Triangle& t : source.faces) {
        const double x = source.positions[t[0]].x() + source.positions[t[1]].x() + source.positions[t[2]].x();
        options.regions.push_back(x < 6 ? 0 : 1);
    }
    const std::vector<SharpEdge> creases = creases_of(source, options);
    ASSERT_EQ(creases.size(), 20U) << "the border and the boundary";
    EXPECT_LE(measured(source, source, creases)->upper, 2e-4);
    TriangleMesh coarse = square(1);
    for (Vec3& p : coarse.positions) p *= 4;
    // The border x = 2 is furthest where its diagonal and its sides are equally far.
    const double furthest = 2 / (1 + std::sqrt(2.0));
    EXPECT_LE(measured(coarse, source, creases)->lower, furthest * (1 + 1e-9));
    EXPECT_GE(measured(coarse, source, creases)->upper, furthest * (1 - 1e-9));
    EXPECT_NEAR(measured(coarse, source, creases)->upper, furthest, 0.03 * furthest);
    EXPECT_EQ(measured(source, source, {}), std::nullopt);
}

TEST(KeptCreasesTest, CreasesKeptAreThoseAlongTheSources) {
    const TriangleMesh source = cube();
    const auto fine = subdivide_to_size(source, 0.3, 100000, ExecutionContext());
    ASSERT_TRUE(fine);
    const std::vector<SharpEdge> all = creases_of(source);
    const std::vector<SharpEdge> kept = creases_kept(fine->mesh, source, all, 20, 1e-6);
    EXPECT_EQ(kept.size(), creases_of(fine->mesh).size());
    EXPECT_TRUE(creases_kept(fine->mesh, source, {}, 20, 1e-6).empty()) << "bends that the source does not know";
    std::vector<SharpEdge> one{all[0]};
    EXPECT_EQ(creases_kept(fine->mesh, source, one, 20, 1e-6).size(), kept.size() / all.size());
    EXPECT_EQ(creases_kept(square(3), source, {}, 20, 1e-6).size(), 12U) << "its boundary";
}

TEST(KeptCreasesTest, OfEdgesAtAFlatCreaseThoseThatRunAlongItAreKept) {
    const TriangleMesh source = square(4);
    FeatureOptions options;
    options.marked_edges = {7, 12, 12, 17};  // two edges of x = 2
    TriangleMesh result = square(8);
    for (Vec3& p : result.positions) p *= 0.5;
    const std::vector<SharpEdge> kept = creases_kept(result, source, creases_of(source, options), 20, 1);
    std::uint32_t inside = 0;
    for (const SharpEdge& edge : kept) {
        const Vec3 middle = (result.positions[edge.a] + result.positions[edge.b]) / 2;
        const bool on_boundary = std::min({middle.x(), middle.y(), 4 - middle.x(), 4 - middle.y()}) < 1e-9;
        if (on_boundary) continue;
        ++inside;
        EXPECT_EQ(middle.x(), 2);
        EXPECT_TRUE(middle.y() > 1 && middle.y() < 3) << middle.y();
    }
    EXPECT_EQ(inside, 4U);
    EXPECT_EQ(kept.size(), 32U + 4);
}

}  // namespace
}  // namespace vsplit::test
