#include "vsplit/quality/crease_deviation.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "tests/core/meshes.h"
#include "vsplit/subdivide/subdivide.h"

namespace vsplit {
namespace {

CreaseDeviation measured(const TriangleMesh& result, const TriangleMesh& source, const CreaseDeviationOptions& options = {},
                         unsigned threads = 0) {
    const ExecutionContext context(nullptr, threads);
    const Expected<CreaseDeviation> deviation = measure_crease_deviation(result, source, options, context);
    EXPECT_TRUE(deviation) << deviation.error().message;
    return deviation ? *deviation : CreaseDeviation{};
}

TriangleMesh moved(TriangleMesh mesh, double scale, const Vec3& by) {
    for (Vec3& p : mesh.positions) p = p * scale + by;
    return mesh;
}

/// Two unit squares that meet along x = 0 at a right angle.
TriangleMesh fold() {
    TriangleMesh mesh;
    mesh.positions = {Vec3(0, 0, 0), Vec3(0, 1, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 0, 1), Vec3(0, 1, 1)};
    mesh.faces = {{0, 2, 3}, {0, 3, 1}, {0, 1, 5}, {0, 5, 4}};
    return mesh;
}

TEST(CreaseDeviationTest, CreasesOfFinerFacesAreThoseOfTheCoarse) {
    const ExecutionContext context;
    for (const TriangleMesh& mesh : {test::cube(), test::plate_with_holes(3), fold()}) {
        const Expected<SubdividedMesh> fine = subdivide_to_size(mesh, 0.11, 1'000'000, context);
        ASSERT_TRUE(fine);
        const CreaseDeviation d = measured(fine->mesh, mesh, {.accuracy = {.absolute_error = 1e-9}});
        EXPECT_LE(d.from_source.upper, 2e-9);
        EXPECT_EQ(d.lost, 0);
        EXPECT_GT(d.result_creases, d.source_creases);
    }
    EXPECT_EQ(measured(test::cube(), test::cube()).source_creases, 12U);
    EXPECT_EQ(measured(fold(), fold()).source_creases, 7U) << "the fold and six edges of the boundary";
}

TEST(CreaseDeviationTest, DistanceIsThatOfTheEdges) {
    const TriangleMesh inner = moved(test::cube(), 0.5, Vec3(0.25, 0.25, 0.25));
    const CreaseDeviation d = measured(inner, test::cube());
    EXPECT_NEAR(d.from_source.lower, std::sqrt(3) / 4, 1e-12) << "corner to corner";
    EXPECT_LE(d.from_source.upper, 1.02 * std::sqrt(3) / 4);
    EXPECT_EQ(d.lost, 1);
}

TEST(CreaseDeviationTest, TheMiddleOfACreaseCountsWhereItsEndsAreKept) {
    // The result's crease runs from end to end in a bow.
    TriangleMesh bowed = fold();
    const auto middle = bowed.vertex_count();
    bowed.positions.emplace_back(0.1, 0.5, 0.1);
    bowed.faces = {{0, 2, middle}, {2, 3, middle}, {3, 1, middle}, {0, middle, 4}, {4, middle, 5}, {5, middle, 1}};
    const CreaseDeviation d = measured(bowed, fold(), {.lost_distance = 0.05});
    const double height = std::sqrt(0.02) * 0.5 / std::sqrt(0.25 + 0.02);  // from the middle to the bow's straight halves
    EXPECT_LE(d.from_source.lower, height + 1e-9);
    EXPECT_NEAR(d.from_source.upper, height, 0.03 * height);
    EXPECT_GT(d.lost, 0.03);
    EXPECT_LT(d.lost, 0.12) << "a part of one of seven edges";
}

TEST(CreaseDeviationTest, LostIsAShareOfLength) {
    // A cube without its top: of the twelve creases of the whole one none is lost, the rim is a boundary now. Without a side
    // face's half too, one edge of four at the top hangs in the air.
    TriangleMesh open = test::cube();
    const auto on_top = [&](const Triangle& t) {
        return std::all_of(t.begin(), t.end(), [&](std::uint32_t v) { return open.positions[v].z() == 1; });
    };
    open.faces.erase(std::remove_if(open.faces.begin(), open.faces.end(), on_top), open.faces.end());
    ASSERT_EQ(open.faces.size(), 10U);
    EXPECT_EQ(measured(open, test::cube()).lost, 0);

    TriangleMesh flat = test::cube();
    flat.faces = {flat.faces[0], flat.faces[1]};  // one square: 4 creases of 12 are kept
    const CreaseDeviation d = measured(flat, test::cube(), {.lost_distance = 1e-3, .spacing = 1e-4});
    EXPECT_NEAR(d.lost, 8.0 / 12, 8 * 2e-3 / 12);
    EXPECT_NEAR(d.from_source.lower, 1, 1e-12);
}

TEST(CreaseDeviationTest, WithoutCreasesThereIsNothingToKeepOrNothingKept) {
    const TriangleMesh sphere = test::icosphere(3);
    const CreaseDeviation nothing = measured(test::cube(), sphere);
    EXPECT_EQ(nothing.source_creases, 0U);
    EXPECT_EQ(nothing.from_source.upper, 0);
    EXPECT_EQ(nothing.lost, 0);
    const CreaseDeviation all = measured(sphere, test::cube());
    EXPECT_EQ(all.result_creases, 0U);
    EXPECT_EQ(all.from_source.upper, std::numeric_limits<double>::infinity());
    EXPECT_EQ(all.lost, 1);
}

TEST(CreaseDeviationTest, TheAngleDecides) {
    const TriangleMesh sphere = test::icosphere(1);
    EXPECT_EQ(measured(sphere, sphere, {.angle = 1}).source_creases, sphere.face_count() * 3 / 2);
    EXPECT_EQ(measured(test::cube(), test::cube(), {.angle = 91}).source_creases, 0U);
}

TEST(CreaseDeviationTest, IsTheSameForAnyNumberOfThreads) {
    const TriangleMesh fine = test::bumpy_sphere(4, 0.1, 1);
    const TriangleMesh coarse = test::bumpy_sphere(3, 0.1, 2);
    const CreaseDeviation one = measured(coarse, fine, {.angle = 10}, 1);
    const CreaseDeviation two = measured(coarse, fine, {.angle = 10}, 2);
    EXPECT_GT(one.source_creases, 100U);
    EXPECT_EQ(one.from_source.lower, two.from_source.lower);
    EXPECT_EQ(one.from_source.upper, two.from_source.upper);
    EXPECT_EQ(one.lost, two.lost);
}

TEST(CreaseDeviationTest, SaysWhatIsWrong) {
    const ExecutionContext context;
    const auto error = [&](const CreaseDeviationOptions& options) {
        const Expected<CreaseDeviation> d = measure_crease_deviation(test::cube(), test::cube(), options, context);
        EXPECT_FALSE(d);
        return d ? Error{} : d.error();
    };
    EXPECT_EQ(error({.angle = 181}).field, "angle");
    EXPECT_EQ(error({.lost_distance = -1}).field, "lost_distance");
    EXPECT_EQ(error({.spacing = std::nan("")}).field, "spacing");
    EXPECT_EQ(error({.spacing = 1e-12}).cause, Cause::kLimitExceeded);
    EXPECT_EQ(error({.accuracy = {.relative_error = 2}}).field, "relative_error");
    EXPECT_EQ(measure_crease_deviation({}, test::cube(), {}, context).error().cause, Cause::kEmptyInput);
    ExecutionContext stopped;
    stopped.cancel();
    EXPECT_EQ(measure_crease_deviation(test::cube(), test::cube(), {}, stopped).error().cause, Cause::kCancelled);
}

}  // namespace
}  // namespace vsplit
