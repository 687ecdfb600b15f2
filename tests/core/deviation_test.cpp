#include "vsplit/quality/deviation.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "quality/deviation_of_index.h"
#include "tests/core/meshes.h"
#include "tests/core/random.h"
#include "tests/core/sampled_deviation.h"
#include "vsplit/io/read_mesh.h"
#include "vsplit/method/improve.h"
#include "vsplit/mrr/progressive_mesh.h"
#include "vsplit/subdivide/subdivide.h"

namespace vsplit {
namespace {

Vec3 random_point(test::Random& random, double reach) {
    return {random.uniform(-reach, reach), random.uniform(-reach, reach), random.uniform(-reach, reach)};
}

Deviation measured(const TriangleMesh& result, const TriangleMesh& source, const DeviationOptions& options = {},
                   unsigned threads = 0) {
    const ExecutionContext context(nullptr, threads);
    const Expected<Deviation> deviation = measure_deviation(result, source, options, context);
    EXPECT_TRUE(deviation) << deviation.error().message;
    return deviation ? *deviation : Deviation{};
}

/// Bounds in order, as near as asked, attained where they say, and no sample beyond.
void expect_certain(const DirectedDeviation& d, const TriangleMesh& from, const TriangleMesh& to, const DeviationOptions& options,
                    int steps) {
    const double diagonal = bounding_box(to).diagonal();
    const double rounding = 1e-12 * std::max(diagonal, bounding_box(from).diagonal());
    EXPECT_LE(d.lower, d.upper);
    const double absolute =
        options.absolute_error > 0 ? options.absolute_error : 1e-5 * std::max(diagonal, bounding_box(from).diagonal());
    EXPECT_LE(d.upper - d.lower, std::max(absolute, options.relative_error * d.lower) + rounding);
    EXPECT_NEAR(std::sqrt(surface_index(to).closest(d.at).squared_distance), d.lower, rounding);
    EXPECT_NEAR(surface_index(from).closest(d.at).squared_distance, 0, rounding) << "a point of what is measured from";
    EXPECT_LE(test::sampled_deviation(from, to, steps), d.upper + rounding);
}

void expect_certain(const TriangleMesh& result, const TriangleMesh& source, const DeviationOptions& options, int steps) {
    const Deviation d = measured(result, source, options);
    expect_certain(d.to_source, result, source, options, steps);
    expect_certain(d.from_source, source, result, options, steps);
}

TriangleMesh moved(TriangleMesh mesh, double scale, const Vec3& by) {
    for (Vec3& p : mesh.positions) p = p * scale + by;
    return mesh;
}

/// A square sheet of n * n cells in z = 0, [0, 1] on a side.
TriangleMesh sheet(std::uint32_t n) {
    TriangleMesh mesh;
    for (std::uint32_t y = 0; y <= n; ++y) {
        for (std::uint32_t x = 0; x <= n; ++x) mesh.positions.emplace_back(double(x) / n, double(y) / n, 0);
    }
    for (std::uint32_t y = 0; y < n; ++y) {
        for (std::uint32_t x = 0; x < n; ++x) {
            const std::uint32_t v = y * (n + 1) + x;
            mesh.faces.push_back({v, v + 1, v + n + 2});
            mesh.faces.push_back({v, v + n + 2, v + n + 1});
        }
    }
    return mesh;
}

TriangleMesh random_triangles(std::uint32_t count, std::uint64_t seed) {
    test::Random random(seed);
    TriangleMesh mesh;
    for (std::uint32_t f = 0; f < count; ++f) {
        const Vec3 at = random_point(random, 2);
        for (int i = 0; i < 3; ++i) mesh.positions.push_back(at + random_point(random, 1));
        mesh.faces.push_back({3 * f, 3 * f + 1, 3 * f + 2});
    }
    return mesh;
}

TEST(DeviationTest, AMeshIsNowhereAwayFromItself) {
    for (const test::NamedMesh& m : test::small_meshes()) {
        SCOPED_TRACE(m.name);
        const Deviation d = measured(m.mesh, test::shuffled(m.mesh, 1));
        EXPECT_LE(d.measured(), 1e-15 * bounding_box(m.mesh).diagonal());
        EXPECT_LE(d.max(), 1e-5 * bounding_box(m.mesh).diagonal());
    }
}

TEST(DeviationTest, CuttingFacesFinerChangesNoDistance) {
    // Where one face lies over many coplanar ones no single face is near it; the bounds must close nevertheless, and soon.
    const ExecutionContext context;
    for (const TriangleMesh& mesh : {test::cube(), test::plate_with_holes(2), test::sliver_cylinder(40, 5)}) {
        const Expected<SubdividedMesh> fine = subdivide_to_size(mesh, 0.15, 1'000'000, context);
        ASSERT_TRUE(fine);
        const Deviation d = measured(fine->mesh, mesh, {.absolute_error = 1e-9});
        EXPECT_LE(d.max(), 2e-9);
        EXPECT_LE(measured(mesh, fine->mesh, {.absolute_error = 1e-9}).max(), 2e-9);
    }
}

TEST(DeviationTest, ParallelPlanesAreTheirDistanceApart) {
    const Deviation d = measured(moved(sheet(5), 1, Vec3(0, 0, 0.25)), sheet(8));
    EXPECT_EQ(d.to_source.lower, 0.25);
    EXPECT_LE(d.max(), 0.25 * 1.02);
    EXPECT_NEAR(measured(moved(sheet(5), 1, Vec3(0, 0, 0.25)), sheet(8), {.relative_error = 0, .absolute_error = 1e-12}).max(),
                0.25, 2e-12)
        << "pieces over one face each are as near as their corners";
}

TEST(DeviationTest, OpenSheetsOfDifferentSizeDifferByTheRim) {
    const TriangleMesh large = moved(sheet(3), 2, Vec3(-0.5, -0.5, 0));
    const Deviation d = measured(sheet(7), large);
    EXPECT_LE(d.to_source.upper, 3e-5);
    EXPECT_NEAR(d.from_source.lower, std::sqrt(0.5), 1e-12) << "the corners";
    EXPECT_LE(d.from_source.upper, 1.02 * std::sqrt(0.5));
}

TEST(DeviationTest, CubeInACubeIsFurthestAtItsCorners) {
    const TriangleMesh outer = moved(test::cube(), 2, Vec3(-0.5, -0.5, -0.5));
    const Deviation d = measured(outer, test::cube());
    EXPECT_NEAR(d.to_source.lower, std::sqrt(0.75), 1e-12);
    EXPECT_NEAR(d.from_source.lower, 0.5, 1e-12);
    EXPECT_LE(d.to_source.upper, 1.02 * std::sqrt(0.75));
    EXPECT_LE(d.from_source.upper, 1.02 * 0.5);
    EXPECT_EQ(d.max(), d.to_source.upper);
    EXPECT_EQ(d.measured(), d.to_source.lower);
}

TEST(DeviationTest, TheMiddleOfAFaceCountsWhereNoVertexIsFar) {
    // A peak under the middle of one large face: a dent that only the way from the source sees in full.
    TriangleMesh flat = sheet(1);
    TriangleMesh dented = sheet(16);
    const std::uint32_t middle = 8 * 17 + 8;
    dented.positions[middle] = Vec3(0.5, 0.5, -0.2);
    const Deviation d = measured(flat, dented);
    EXPECT_NEAR(d.from_source.lower, 0.2, 1e-12);
    EXPECT_NEAR(d.from_source.at.z(), -0.2, 1e-12);
    EXPECT_LT(d.to_source.upper, 0.065) << "above the dent its rim is near";
    EXPECT_NEAR(d.to_source.lower, test::sampled_deviation(flat, dented, 400), 0.02 * d.to_source.upper);
    expect_certain(flat, dented, {}, 64);
}

TEST(DeviationTest, ASphereAgainstCoarseOnes) {
    const TriangleMesh fine = test::icosphere(5);
    for (unsigned coarse = 0; coarse < 4; ++coarse) {
        SCOPED_TRACE(coarse);
        const Deviation d = measured(test::icosphere(coarse), fine);
        const double dense = test::sampled_deviation(test::icosphere(coarse), fine, 80 >> coarse);
        EXPECT_LE(dense, d.to_source.upper + 1e-12);
        EXPECT_GE(dense, 0.95 * d.to_source.lower);
        expect_certain(test::icosphere(coarse), fine, {}, 8);
    }
}

TEST(DeviationTest, HoldsForTrianglesInAnyPosition) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        SCOPED_TRACE(seed);
        expect_certain(random_triangles(1 + static_cast<std::uint32_t>(seed), seed), random_triangles(7, seed + 100), {}, 40);
        expect_certain(random_triangles(30, seed), random_triangles(40, seed + 100), {.relative_error = 0.001}, 20);
    }
}

TEST(DeviationTest, HoldsForDegenerateFaces) {
    TriangleMesh odd = random_triangles(12, 5);
    for (std::size_t f = 0; f < 12; ++f) {
        if (f % 3 == 0) odd.positions[3 * f + 1] = odd.positions[3 * f];
        if (f % 3 == 1) odd.positions[3 * f + 2] = (odd.positions[3 * f] + odd.positions[3 * f + 1]) / 2;
        if (f % 6 == 3) odd.positions[3 * f + 2] = odd.positions[3 * f];
    }
    expect_certain(odd, random_triangles(5, 6), {}, 40);
    expect_certain(odd, moved(odd, 1.1, Vec3(0.1, 0, 0)), {}, 40);
    TriangleMesh point;
    point.positions = {Vec3(1, 2, 3), Vec3(1, 2, 3)};
    point.faces = {{0, 1, 0}};
    const Deviation d = measured(point, moved(point, 1, Vec3(0, 0, 2)));
    EXPECT_EQ(d.measured(), 2);
    EXPECT_LE(d.max(), 2.04);
}

TEST(DeviationTest, VerticesOfNoFaceAreNoPartOfASurface) {
    TriangleMesh mesh = test::cube();
    mesh.positions.emplace_back(0.5, 0.5, 0.5);
    EXPECT_EQ(measured(mesh, test::cube()).measured(), 0);
}

TEST(DeviationTest, TighterAsked) {
    const TriangleMesh fine = test::bumpy_sphere(4, 0.05, 3);
    const TriangleMesh coarse = test::icosphere(2);
    const Deviation rough = measured(coarse, fine, {.relative_error = 0.3});
    const Deviation tight = measured(coarse, fine, {.relative_error = 1e-4});
    EXPECT_LE(tight.to_source.upper, 1.0001 * tight.to_source.lower + 1e-5 * bounding_box(fine).diagonal());
    EXPECT_LE(rough.to_source.lower, tight.to_source.upper);
    EXPECT_LE(tight.to_source.lower, rough.to_source.upper);
    EXPECT_GE(tight.measured(), 0.7 * rough.max());
}

TEST(DeviationTest, WhenTheBudgetEndsTheBoundsAreWiderAndTrue) {
    const TriangleMesh fine = test::icosphere(4);
    const TriangleMesh coarse = test::icosphere(0);
    const DeviationOptions tight{.relative_error = 0, .absolute_error = 1e-9};
    DeviationOptions poor = tight;
    poor.evaluations = 1;
    const Deviation cut_short = measured(coarse, fine, poor);
    const Deviation whole = measured(coarse, fine, {.relative_error = 1e-4});
    EXPECT_GT(cut_short.max() - cut_short.measured(), 1e-6) << "there was work left";
    EXPECT_LE(cut_short.measured(), whole.max());
    EXPECT_GE(cut_short.max(), whole.measured());
    EXPECT_GE(cut_short.to_source.upper, test::sampled_deviation(coarse, fine, 60));
}

TEST(DeviationTest, IsTheSameForAnyNumberOfThreads) {
    const TriangleMesh fine = test::bumpy_sphere(5, 0.03, 4);
    const TriangleMesh coarse = test::bumpy_sphere(4, 0.03, 5);
    const auto equal = [](const DirectedDeviation& l, const DirectedDeviation& r) {
        return l.lower == r.lower && l.upper == r.upper && l.at == r.at;
    };
    for (const DeviationOptions& options :
         {DeviationOptions{}, DeviationOptions{.relative_error = 1e-3, .evaluations = 20'000}}) {
        const Deviation one = measured(coarse, fine, options, 1);
        const Deviation two = measured(coarse, fine, options, 2);
        EXPECT_TRUE(equal(one.to_source, two.to_source));
        EXPECT_TRUE(equal(one.from_source, two.from_source));
    }
}

TEST(DeviationTest, IndicesAtHandGiveTheSameAnswer) {
    const TriangleMesh fine = test::bumpy_sphere(3, 0.03, 4);
    const TriangleMesh coarse = test::icosphere(2);
    const SurfaceIndex fine_index = surface_index(fine);
    const SurfaceIndex coarse_index = surface_index(coarse);
    const ExecutionContext context;
    const Deviation plain = measured(coarse, fine);
    const Expected<Deviation> indexed =
        measure_deviation(IndexedMesh{coarse, coarse_index}, IndexedMesh{fine, fine_index}, {}, context);
    ASSERT_TRUE(indexed);
    EXPECT_EQ(indexed->max(), plain.max());
    EXPECT_EQ(indexed->measured(), plain.measured());
    const Expected<DirectedDeviation> one_way =
        measure_directed_deviation(coarse, fine_index, bounding_box(fine).diagonal(), {}, context);
    ASSERT_TRUE(one_way);
    EXPECT_EQ(one_way->upper, plain.to_source.upper);
}

TEST(DeviationTest, SaysWhatIsWrongWithOptionsAndMeshes) {
    const ExecutionContext context;
    const auto error = [&](const TriangleMesh& result, const DeviationOptions& options) {
        const Expected<Deviation> d = measure_deviation(result, test::cube(), options, context);
        EXPECT_FALSE(d);
        return d ? Error{} : d.error();
    };
    EXPECT_EQ(error(test::cube(), {.relative_error = -1}).field, "relative_error");
    EXPECT_EQ(error(test::cube(), {.relative_error = std::nan("")}).field, "relative_error");
    EXPECT_EQ(error(test::cube(), {.absolute_error = -1e-3}).field, "absolute_error");
    EXPECT_EQ(error({}, {}).cause, Cause::kEmptyInput);
    EXPECT_NE(error({}, {}).message.find("the result has no faces"), std::string::npos);
    EXPECT_EQ(measure_deviation(test::cube(), {}, {}, context).error().cause, Cause::kEmptyInput);
}

TEST(DeviationTest, ReportsProgressAndObeysCancel) {
    const TriangleMesh fine = test::bumpy_sphere(5, 0.03, 4);
    std::vector<Progress> told;
    ExecutionContext listening([&](const Progress& p) { told.push_back(p); });
    ASSERT_TRUE(measure_deviation(fine, fine, {}, listening));
    ASSERT_GT(told.size(), 5U);
    for (std::size_t i = 0; i < told.size(); ++i) {
        EXPECT_EQ(told[i].stage, "measure");
        if (i > 0) {
            EXPECT_GE(told[i].fraction, told[i - 1].fraction);
        }
    }
    EXPECT_EQ(told.back().fraction, 1);

    std::size_t heard = 0;
    ExecutionContext* stop = nullptr;
    ExecutionContext stopping([&](const Progress&) {
        if (++heard == 3) stop->cancel();
    });
    stop = &stopping;
    const Expected<Deviation> stopped = measure_deviation(fine, fine, {}, stopping);
    ASSERT_FALSE(stopped);
    EXPECT_EQ(stopped.error().cause, Cause::kCancelled);
    EXPECT_EQ(heard, 3U);
}

TEST(DeviationTest, HoldsForImprovedParts) {
    std::vector<std::filesystem::path> files = test::own_closed_meshes();
    for (const auto& file : test::shared_closed_meshes()) {
        if (file.stem() == "cad_fanuc_lrmate200id_link3") files.push_back(file);
    }
    for (const auto& file : files) {
        SCOPED_TRACE(test::test_name(file));
        const Expected<ReadResult> read = read_mesh_file(file.string(), {});
        ASSERT_TRUE(read);
        const ExecutionContext context;
        ImproveOptions options;
        options.subdivision_size = 0.03 * bounding_box(read->mesh).diagonal();
        options.faces = 2000;
        const Expected<MethodResult> made = improve(read->mesh, options, {}, context);
        ASSERT_TRUE(made);
        const TriangleMesh result = mesh_at(made->mrr, made->mrr.level_for(made->faces));
        expect_certain(result, read->mesh, {}, 4);
    }
}

}  // namespace
}  // namespace vsplit
