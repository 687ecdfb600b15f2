#include "vsplit/shapes/remove_features.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tests/core/drilled_plate.h"
#include "tests/core/meshes.h"
#include "vsplit/io/read_mesh.h"
#include "vsplit/mesh/inspect.h"
#include "vsplit/method/improve.h"
#include "vsplit/mrr/progressive_mesh.h"
#include "vsplit/quality/stretch.h"

namespace vsplit {
namespace {

constexpr double kThickness = 4;

TriangleMesh forty_holes() { return test::drilled_plate(8, 10, kThickness, test::forty_drillings(kThickness)); }

Expected<FeaturelessMesh> removed_from(const TriangleMesh& mesh, const FeatureRemoval& removal) {
    const ExecutionContext context;
    return remove_features(mesh, removal, context);
}

FeaturelessMesh without_all(const TriangleMesh& mesh) {
    const auto result = removed_from(mesh, {{}, {}, 1e9});
    EXPECT_TRUE(result) << result.error().message;
    return result ? *result : FeaturelessMesh{};
}

struct NewFaces {
    double least_stretch = 1;
    double mean_size = 0;
    double largest_size = 0;
};

NewFaces measure(const FeaturelessMesh& result) {
    NewFaces measured;
    const TriangleMesh& mesh = result.mesh;
    const double count = mesh.face_count() - result.first_new_face;
    for (std::uint32_t f = result.first_new_face; f < mesh.face_count(); ++f) {
        const Triangle& t = mesh.faces[f];
        const Vec3 &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
        measured.least_stretch = std::min(measured.least_stretch, stretch(a, b, c));
        measured.mean_size += face_size(a, b, c) / count;
        measured.largest_size = std::max(measured.largest_size, face_size(a, b, c));
    }
    return measured;
}

void expect_rest_is_the_same(const TriangleMesh& before, const FeaturelessMesh& after) {
    ASSERT_EQ(after.parent.size(), after.mesh.faces.size());
    for (std::uint32_t f = 0; f < after.first_new_face; ++f) {
        if (f > 0) {
            ASSERT_LT(after.parent[f - 1], after.parent[f]);
        }
        for (std::size_t i = 0; i < 3; ++i)
            ASSERT_EQ(after.mesh.positions[after.mesh.faces[f][i]], before.positions[before.faces[after.parent[f]][i]]);
    }
}

TEST(RemoveFeaturesTest, FillsFortyHolesOfACadPlate) {
    const TriangleMesh mesh = forty_holes();
    const FeaturelessMesh result = without_all(mesh);
    EXPECT_EQ(result.removed.size(), 40U);
    EXPECT_TRUE(result.kept.empty());
    expect_rest_is_the_same(mesh, result);
    const MeshReport report = inspect(result.mesh);
    EXPECT_TRUE(report.closed);
    EXPECT_EQ(report.genus, 0);
    EXPECT_EQ(report.components, 1U);
    EXPECT_NEAR(enclosed_volume(result.mesh), 80 * 50 * kThickness, 1e-6);
    EXPECT_GE(measure(result).least_stretch, 0.3);
}

TEST(RemoveFeaturesTest, NewFacesFitAMeshMadeForAnalysis) {
    ImproveOptions options;
    options.subdivision_size = 1;
    options.tolerance = 0.02;
    const ExecutionContext context;
    const auto improved = improve(forty_holes(), options, {}, context);
    ASSERT_TRUE(improved) << improved.error().message;
    const TriangleMesh mesh = mesh_at(improved->mrr, improved->mrr.level_for(improved->faces));
    const auto features = list_features(mesh);
    ASSERT_TRUE(features);
    ASSERT_EQ(features->size(), 40U);
    const std::vector<test::Drilling> drillings = test::forty_drillings(kThickness);
    for (const ShapeFeature& f : *features) {
        const auto column = static_cast<std::uint32_t>(f.centre.x() / 10), row = static_cast<std::uint32_t>(f.centre.y() / 10);
        const double diameter = drillings[8 * row + column].diameter;
        EXPECT_NEAR(f.diameter, diameter, 0.01 * diameter);
    }
    const FeaturelessMesh result = without_all(mesh);
    EXPECT_EQ(result.removed.size(), 40U);
    expect_rest_is_the_same(mesh, result);
    EXPECT_TRUE(inspect(result.mesh).closed);
    const NewFaces measured = measure(result);
    EXPECT_GE(measured.least_stretch, 0.3);
    EXPECT_NEAR(measured.mean_size, result.size, 0.2 * result.size);
}

TEST(RemoveFeaturesTest, EachHoleTakesItsVolumeAndThroughHolesTheirGenus) {
    const TriangleMesh mesh = forty_holes();
    const std::vector<test::Drilling> drillings = test::forty_drillings(kThickness);
    const auto features = list_features(mesh);
    ASSERT_TRUE(features);
    const int genus = inspect(mesh).genus;
    for (const std::uint32_t id : {0U, 3U, 17U}) {
        const ShapeFeature& feature = (*features)[id];
        const auto result = removed_from(mesh, {{}, {id}, {}});
        ASSERT_TRUE(result) << result.error().message;
        EXPECT_EQ(result->removed, std::vector<std::uint32_t>{id});
        const bool through = feature.kind == ShapeFeature::Kind::kThroughHole;
        EXPECT_EQ(inspect(result->mesh).genus, genus - (through ? 1 : 0));
        const auto column = static_cast<std::uint32_t>(feature.centre.x() / 10),
                   row = static_cast<std::uint32_t>(feature.centre.y() / 10);
        const test::Drilling& drilling = drillings[8 * row + column];
        const double cylinder = test::polygon_area(drilling.diameter, drilling.sides) * drilling.depth;
        EXPECT_NEAR(enclosed_volume(result->mesh) - enclosed_volume(mesh), cylinder, 1e-9 * cylinder + 1e-9);
    }
}

TEST(RemoveFeaturesTest, ABossLeavesAFlatPlate) {
    const FeaturelessMesh result = without_all(test::drilled_plate(1, 10, 3, {{4, -2.5, 32}}));
    EXPECT_EQ(result.removed.size(), 1U);
    EXPECT_TRUE(inspect(result.mesh).closed);
    EXPECT_NEAR(enclosed_volume(result.mesh), 300, 1e-9);
}

TEST(RemoveFeaturesTest, ADiameterTakesTheSmallOnes) {
    const TriangleMesh mesh = forty_holes();
    const auto result = removed_from(mesh, {{}, {}, 3.01});
    ASSERT_TRUE(result);
    EXPECT_EQ(result->removed.size(), 16U);
    const auto left = list_features(result->mesh);
    ASSERT_TRUE(left);
    EXPECT_EQ(left->size(), 24U);
    for (const ShapeFeature& f : *left) EXPECT_GT(f.diameter, 3.01);
}

TEST(RemoveFeaturesTest, ADiameterIsTheSameInAFileOfFloats) {
    TriangleMesh mesh = test::drilled_plate(2, 10, 3, {{3, 3, 24}, {3.01, 3, 24}});
    for (Vec3& p : mesh.positions) p = (p * (1 + 1e-6)).cast<float>().cast<double>();
    const auto features = list_features(mesh);
    ASSERT_TRUE(features);
    ASSERT_EQ(features->size(), 2U);
    EXPECT_GT((*features)[0].diameter, 3);
    const auto result = removed_from(mesh, {{}, {}, 3.0});
    ASSERT_TRUE(result);
    EXPECT_EQ(result->removed, std::vector<std::uint32_t>{0});
}

TEST(RemoveFeaturesTest, RimsOfShortEdgesGetFacesAsLargeAsTheyCanBe) {
    // Holes up to 4.5 times as wide as the mesh's faces are in the mean, with rims of edges much shorter than those.
    std::vector<test::Drilling> drillings;
    for (std::uint32_t i = 0; i < 40; ++i) drillings.push_back({2 + 0.1 * i, 4, 24});
    TriangleMesh mesh = test::drilled_plate(8, 10, kThickness, drillings);
    ImproveOptions options;
    options.subdivision_size = 1.3;
    options.tolerance = 0.01;
    options.faces = 40'000;
    const ExecutionContext context;
    const auto improved = improve(mesh, options, {}, context);
    ASSERT_TRUE(improved) << improved.error().message;
    mesh = mesh_at(improved->mrr, improved->mrr.level_for(improved->faces));
    const FeaturelessMesh result = without_all(mesh);
    EXPECT_EQ(result.removed.size(), 40U);
    const NewFaces measured = measure(result);
    EXPECT_GE(measured.least_stretch, 0.3);
    EXPECT_LE(measured.largest_size, result.size * (1 + 1e-9));
    EXPECT_NEAR(measured.mean_size, result.size, 0.2 * result.size);
}

TEST(RemoveFeaturesTest, TinyHolesOfACoarsePlateGetGoodFaces) {
    const FeaturelessMesh result = without_all(test::drilled_plate(8, 10, 5, std::vector<test::Drilling>(40, {0.2, 5, 64})));
    EXPECT_EQ(result.removed.size(), 40U);
    EXPECT_GE(measure(result).least_stretch, 0.3);
}

TEST(RemoveFeaturesTest, RegionsAndSetsStay) {
    TriangleMesh mesh = forty_holes();
    mesh.regions.resize(mesh.faces.size());
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        const Triangle& t = mesh.faces[f];
        const bool top = std::all_of(t.begin(), t.end(), [&](std::uint32_t v) { return mesh.positions[v].z() == 0; });
        mesh.regions[f] = top ? 5 : 9;
    }
    mesh.sets = {{"top", {5}}};
    const FeaturelessMesh result = without_all(mesh);
    EXPECT_EQ(result.mesh.sets, mesh.sets);
    ASSERT_EQ(result.mesh.regions.size(), result.mesh.faces.size());
    for (std::uint32_t f = 0; f < result.mesh.face_count(); ++f) {
        const Triangle& t = result.mesh.faces[f];
        const bool top = std::all_of(t.begin(), t.end(), [&](std::uint32_t v) { return result.mesh.positions[v].z() == 0; });
        EXPECT_EQ(result.mesh.regions[f], top ? 5U : 9U);
    }
}

TEST(RemoveFeaturesTest, TheSameBytesEveryTime) {
    const TriangleMesh mesh = forty_holes();
    EXPECT_EQ(without_all(mesh).mesh, without_all(mesh).mesh);
}

TEST(RemoveFeaturesTest, NothingUnderTheDiameterChangesNothing) {
    const TriangleMesh mesh = forty_holes();
    const auto result = removed_from(mesh, {{}, {}, 0.5});
    ASSERT_TRUE(result);
    EXPECT_TRUE(result->removed.empty());
    EXPECT_EQ(result->mesh, mesh);
}

TEST(RemoveFeaturesTest, ARimThatCannotBeFilledKeepsItsFeature) {
    // A blind hole of 504 sides: more than are filled.
    const TriangleMesh mesh = test::drilled_plate(1, 10, 3, {{4, 2, 504}});
    const FeaturelessMesh result = without_all(mesh);
    EXPECT_TRUE(result.removed.empty());
    ASSERT_EQ(result.kept.size(), 1U);
    EXPECT_NE(result.kept[0].reason.find("504"), std::string::npos);
    EXPECT_EQ(result.mesh, mesh);
}

TEST(RemoveFeaturesTest, SaysWhatItDoesNotTake) {
    const TriangleMesh mesh = test::drilled_plate(1, 10, 3, {{4, 3, 16}});
    const auto nothing = removed_from(mesh, {});
    ASSERT_FALSE(nothing);
    EXPECT_EQ(nothing.error().field, "ids");
    const auto unknown = removed_from(mesh, {{}, {1}, {}});
    ASSERT_FALSE(unknown);
    EXPECT_EQ(unknown.error().cause, Cause::kInvalidOption);
    EXPECT_NE(unknown.error().message.find("feature 1"), std::string::npos);
    const auto negative = removed_from(mesh, {{}, {}, -1.0});
    ASSERT_FALSE(negative);
    EXPECT_EQ(negative.error().field, "max_diameter");
    const auto open = removed_from(test::square(3), {{}, {}, 1.0});
    ASSERT_FALSE(open);
    EXPECT_EQ(open.error().cause, Cause::kOpenMesh);
    ExecutionContext stopped;
    stopped.cancel();
    const auto cancelled = remove_features(mesh, {{}, {0}, {}}, stopped);
    ASSERT_FALSE(cancelled);
    EXPECT_EQ(cancelled.error().cause, Cause::kCancelled);
}

TEST(RemoveFeaturesTest, TheCrankshaftLosesItsOilHoles) {
    const auto read = read_mesh_file(test::data_file("crankshaft.stl"), {});
    ASSERT_TRUE(read) << read.error().message;
    const auto features = list_features(read->mesh);
    ASSERT_TRUE(features);
    FeatureRemoval removal;
    for (const ShapeFeature& f : *features) {
        if (f.kind == ShapeFeature::Kind::kThroughHole) removal.ids.push_back(f.id);
    }
    const auto result = removed_from(read->mesh, removal);
    ASSERT_TRUE(result) << result.error().message;
    EXPECT_EQ(result->removed, removal.ids);
    expect_rest_is_the_same(read->mesh, *result);
    const MeshReport before = inspect(read->mesh), after = inspect(result->mesh);
    EXPECT_TRUE(after.closed);
    EXPECT_EQ(after.genus, before.genus - static_cast<int>(removal.ids.size()));
    EXPECT_GT(enclosed_volume(result->mesh), enclosed_volume(read->mesh));
}

}  // namespace
}  // namespace vsplit
