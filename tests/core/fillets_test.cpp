#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/core/filleted_parts.h"
#include "tests/core/meshes.h"
#include "vsplit/io/read_mesh.h"
#include "vsplit/mesh/inspect.h"
#include "vsplit/shapes/remove_features.h"

namespace vsplit {
namespace {

using Kind = ShapeFeature::Kind;

std::vector<ShapeFeature> fillets_of(const TriangleMesh& mesh) {
    const MeshReport report = inspect(mesh);
    EXPECT_TRUE(report.closed);
    const auto features = list_features(mesh);
    EXPECT_TRUE(features) << features.error().message;
    std::vector<ShapeFeature> fillets;
    if (!features) return fillets;
    for (const ShapeFeature& f : *features) {
        if (f.kind == Kind::kFillet) fillets.push_back(f);
    }
    return fillets;
}

FeaturelessMesh without(const TriangleMesh& mesh, const std::vector<ShapeFeature>& features) {
    FeatureRemoval removal;
    for (const ShapeFeature& f : features) removal.ids.push_back(f.id);
    const ExecutionContext context;
    const auto result = remove_features(mesh, removal, context);
    EXPECT_TRUE(result) << result.error().message;
    return result ? *result : FeaturelessMesh{};
}

void expect_rest_is_the_same(const TriangleMesh& before, const FeaturelessMesh& after) {
    ASSERT_EQ(after.parent.size(), after.mesh.faces.size());
    for (std::uint32_t f = 0; f < after.first_new_face; ++f) {
        for (std::size_t i = 0; i < 3; ++i)
            ASSERT_EQ(after.mesh.positions[after.mesh.faces[f][i]], before.positions[before.faces[after.parent[f]][i]]);
    }
    for (std::uint32_t f = 0, kept = 0; f < before.face_count(); ++f) {
        if (kept < after.first_new_face && after.parent[kept] == f) ++kept;
        if (f + 1 == before.face_count()) {
            EXPECT_EQ(kept, after.first_new_face) << "in order, each once";
        }
    }
}

void expect_all_removed(const TriangleMesh& mesh, const FeaturelessMesh& result, std::size_t count) {
    for (const KeptFeature& kept : result.kept) ADD_FAILURE() << kept.id << ": " << kept.reason;
    EXPECT_EQ(result.removed.size(), count);
    expect_rest_is_the_same(mesh, result);
    const MeshReport before = inspect(mesh), after = inspect(result.mesh);
    EXPECT_TRUE(after.closed);
    EXPECT_EQ(after.genus, before.genus);
    EXPECT_EQ(after.components, before.components);
    EXPECT_TRUE(fillets_of(result.mesh).empty());
}

TEST(FilletsTest, FindsTheRoundedEdgeOfABlock) {
    for (const std::uint32_t strips : {3U, 4U, 8U, 30U}) {
        const std::vector<ShapeFeature> found = fillets_of(test::shuffled(test::rounded_block(2, strips, 40), strips));
        ASSERT_EQ(found.size(), 1U) << strips;
        EXPECT_NEAR(found[0].diameter, 4, 1e-9);
        EXPECT_NEAR(found[0].depth, 40, 1e-9);
        EXPECT_NEAR(std::abs(found[0].axis.z()), 1, 1e-9);
        EXPECT_LT((found[0].centre - Vec3(18, 8, 20)).norm(), 1e-9);
        EXPECT_EQ(found[0].faces.size(), 2 * strips);
        for (const auto& side : found[0].sides) EXPECT_EQ(side.size(), 2U);
    }
}

TEST(FilletsTest, FindsTheInnerFilletOfAnAngle) {
    for (const std::uint32_t strips : {3U, 6U, 16U}) {
        const std::vector<ShapeFeature> found = fillets_of(test::shuffled(test::rounded_angle(3, strips, 60), strips));
        ASSERT_EQ(found.size(), 1U) << strips;
        EXPECT_NEAR(found[0].diameter, 6, 1e-9);
        EXPECT_NEAR(found[0].depth, 60, 1e-9);
        EXPECT_NEAR(std::abs(found[0].axis.z()), 1, 1e-9);
        EXPECT_LT((found[0].centre - Vec3(8, 8, 30)).norm(), 1e-9);
    }
}

TEST(FilletsTest, FindsRingsAroundABossAndAHole) {
    for (const std::uint32_t around : {24U, 32U, 96U}) {
        for (const std::uint32_t strips : {3U, 4U, 9U}) {
            const double radius = 1.5, sides = around;
            for (const TriangleMesh& mesh :
                 {test::boss_with_rounded_foot(radius, strips, around), test::hole_with_rounded_mouth(radius, strips, around)}) {
                const std::vector<ShapeFeature> found = fillets_of(test::shuffled(mesh, strips));
                ASSERT_EQ(found.size(), 1U) << around << " " << strips;
                EXPECT_NEAR(found[0].diameter, 2 * radius, 0.01 * 2 * radius);
                EXPECT_NEAR(found[0].depth, 2 * sides * std::sin(std::numbers::pi / sides) * (6 + radius / 2), 1e-6);
                EXPECT_NEAR(std::abs(found[0].axis.z()), 1, 1e-9);
                EXPECT_LT((found[0].centre.head<2>() - Eigen::Vector2d(15, 15)).norm(), 1e-6);
                EXPECT_EQ(found[0].faces.size(), 2 * strips * around);
            }
        }
    }
}

TEST(FilletsTest, FindsARunOnNoLineOrCircle) {
    for (const std::uint32_t around : {12U, 24U, 48U}) {
        const TriangleMesh mesh = test::rounded_slab(2, 6, around);
        const std::vector<ShapeFeature> found = fillets_of(test::shuffled(mesh, around));
        ASSERT_EQ(found.size(), 1U) << around;
        EXPECT_NEAR(found[0].diameter, 4, 0.04) << around;
        const double arcs = 2 * around * 2 * std::sin(std::numbers::pi / (2 * around)) * (8 - 1);
        EXPECT_NEAR(found[0].depth, 60 + arcs, 1e-6);
        EXPECT_NEAR(std::abs(found[0].axis.z()), 1, 1e-6);
        EXPECT_LT(found[0].centre.head<2>().norm(), 1e-6);
        expect_all_removed(mesh, without(mesh, fillets_of(mesh)), 1);
    }
}

TEST(FilletsTest, OtherShapesHaveNone) {
    for (const TriangleMesh& mesh :
         {test::rounded_block(0, 0, 40), test::cube(), test::sliver_cylinder(32, 3), test::sliver_cylinder(64, 0.5),
          test::icosphere(2), test::icosphere(4), test::torus(24, 12), test::torus(96, 64), test::plate_with_holes(3),
          test::bumpy_sphere(3, 0.02, 5), test::bumpy_sphere(5, 0.005, 6), test::noisy_cube(20, 0.1, 7),
          test::noisy_cube(20, 0.01, 8)})
        EXPECT_TRUE(fillets_of(mesh).empty());
    for (const char* name : {"scan.ply", "combined.stl"}) {
        const auto read = read_mesh_file(test::data_file(name), {});
        ASSERT_TRUE(read) << read.error().message;
        EXPECT_TRUE(fillets_of(read->mesh).empty()) << name;
    }
}

TEST(FilletsTest, AChamferOrAnArcThatIsNotTangentIsNone) {
    for (const std::uint32_t strips : {1U, 2U}) EXPECT_TRUE(fillets_of(test::rounded_block(2, strips, 40)).empty());
    TriangleMesh sheared = test::rounded_block(2, 6, 40);
    for (Vec3& p : sheared.positions) {
        if (p.x() < 1) p.y() *= 3;  // the top now falls towards the arc and meets it at an edge
    }
    EXPECT_TRUE(fillets_of(sheared).empty());
}

TEST(FilletsTest, ABlockWithoutItIsChamfered) {
    const TriangleMesh mesh = test::rounded_block(2, 8, 40);
    const FeaturelessMesh result = without(mesh, fillets_of(mesh));
    expect_all_removed(mesh, result, 1);
    EXPECT_NEAR(enclosed_volume(result.mesh), (20 * 10 - 2.0 * 2 / 2) * 40, 1e-9);
}

TEST(FilletsTest, AnAngleWithoutItIsChamfered) {
    const TriangleMesh mesh = test::rounded_angle(3, 6, 60);
    const FeaturelessMesh result = without(mesh, fillets_of(mesh));
    expect_all_removed(mesh, result, 1);
    EXPECT_NEAR(enclosed_volume(result.mesh), (20 * 5 + 15 * 5 + 3.0 * 3 / 2) * 60, 1e-9);
}

TEST(FilletsTest, RingsBecomeCones) {
    const TriangleMesh boss = test::boss_with_rounded_foot(1.5, 6, 32), hole = test::hole_with_rounded_mouth(1.5, 6, 32);
    const FeaturelessMesh footless = without(boss, fillets_of(boss)), mouthless = without(hole, fillets_of(hole));
    expect_all_removed(boss, footless, 1);
    expect_all_removed(hole, mouthless, 1);
    // The frustum between the same two polygons, in the place of what bulges in or out of it.
    const double area = 32 * std::sin(2 * std::numbers::pi / 32) / 2;
    const double frustum = area * 1.5 / 3 * (6 * 6 + 6 * 7.5 + 7.5 * 7.5);
    EXPECT_NEAR(enclosed_volume(footless.mesh), 30 * 30 * 5 + frustum + area * 36 * 6.5, 0.002 * frustum);
    EXPECT_NEAR(enclosed_volume(mouthless.mesh), 30 * 30 * 5 - frustum - area * 36 * 3.5, 0.002 * frustum);
}

TEST(FilletsTest, ADiameterTakesSmallOnes) {
    const TriangleMesh mesh = test::rounded_block(2, 8, 40);
    const ExecutionContext context;
    const auto none = remove_features(mesh, {{}, {}, 3.9}, context), one = remove_features(mesh, {{}, {}, 4.1}, context);
    ASSERT_TRUE(none && one);
    EXPECT_EQ(none->mesh, mesh);
    EXPECT_EQ(one->removed.size(), 1U);
}

TEST(FilletsTest, ADiameterTakesTheKindsAskedFor) {
    const auto read = read_mesh_file(test::data_file("bracket.stl"), {});
    ASSERT_TRUE(read) << read.error().message;
    const auto all = list_features(read->mesh);
    ASSERT_TRUE(all);
    const ExecutionContext context;
    for (const bool holes : {true, false}) {
        FeatureRemoval removal;
        removal.max_diameter = 6.5;
        removal.kinds = holes ? std::vector{Kind::kThroughHole, Kind::kBlindHole} : std::vector{Kind::kFillet};
        const auto result = remove_features(read->mesh, removal, context);
        ASSERT_TRUE(result) << result.error().message;
        EXPECT_EQ(result->removed.size(), holes ? 6U : 2U);
        for (const std::uint32_t id : result->removed) EXPECT_EQ((*all)[id].kind == Kind::kFillet, !holes);
    }
    FeatureRemoval alone;
    alone.ids = {0};
    alone.kinds = {Kind::kFillet};
    const auto refused = remove_features(read->mesh, alone, context);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().field, "kinds");
}

TEST(FilletsTest, RegionsStayOnTheirSurfaces) {
    TriangleMesh mesh = test::rounded_block(2, 8, 40);
    mesh.regions.resize(mesh.faces.size());
    const auto on_end = [](const TriangleMesh& m, std::uint32_t f) {
        const double z = m.positions[m.faces[f][0]].z();
        return std::all_of(m.faces[f].begin(), m.faces[f].end(), [&](std::uint32_t v) { return m.positions[v].z() == z; });
    };
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) mesh.regions[f] = on_end(mesh, f) ? 3 : 8;
    const FeaturelessMesh result = without(mesh, fillets_of(mesh));
    ASSERT_EQ(result.removed.size(), 1U);
    for (std::uint32_t f = 0; f < result.mesh.face_count(); ++f)
        EXPECT_EQ(result.mesh.regions[f], on_end(result.mesh, f) ? 3U : 8U) << f;
}

TEST(FilletsTest, ARoundedBoxHasTwelveThatEndOnItsRoundCorners) {
    const TriangleMesh mesh = test::rounded_box({30, 20, 15}, 3, 6);
    const std::vector<ShapeFeature> found = fillets_of(test::shuffled(mesh, 3));
    ASSERT_EQ(found.size(), 12U);
    double length = 0;
    for (const ShapeFeature& f : found) {
        EXPECT_NEAR(f.diameter, 6, 1e-9);
        length += f.depth;
    }
    EXPECT_NEAR(length, 4 * (24 + 14 + 9), 1e-9);
    const FeaturelessMesh result = without(mesh, fillets_of(mesh));
    EXPECT_EQ(result.kept.size(), 12U);
    EXPECT_EQ(result.mesh, mesh);
}

TEST(FilletsTest, OneThatEndsOnABentSurfaceIsKept) {
    TriangleMesh mesh = test::rounded_block(2, 8, 40);
    for (Vec3& p : mesh.positions) {
        if (p.z() > 20) p.z() += 0.02 * (p.x() - p.y()) * (p.x() - p.y());
    }
    const FeaturelessMesh result = without(mesh, fillets_of(mesh));
    EXPECT_TRUE(result.removed.empty());
    ASSERT_EQ(result.kept.size(), 1U);
    EXPECT_NE(result.kept[0].reason.find("one plane"), std::string::npos) << result.kept[0].reason;
    EXPECT_EQ(result.mesh, mesh);
}

TEST(FilletsTest, FindsAllThatTheBracketWasMadeWith) {
    const auto read = read_mesh_file(test::data_file("bracket.stl"), {});
    ASSERT_TRUE(read) << read.error().message;
    const std::vector<ShapeFeature> found = fillets_of(read->mesh);
    ASSERT_EQ(found.size(), 6U);  // two rings of radius 3 at the boss, four corners of 14
    std::vector<ShapeFeature> rings;
    for (const ShapeFeature& f : found) {
        if (f.diameter > 10) {
            EXPECT_NEAR(f.diameter, 28, 0.01);
            EXPECT_NEAR(f.depth, 14, 1e-4);
            continue;
        }
        EXPECT_NEAR(f.diameter, 6, 0.001);
        EXPECT_NEAR(std::abs(f.axis.x()), 1, 1e-5);
        EXPECT_LT((f.centre.tail<2>() - Eigen::Vector2d(50, 88)).norm(), 1e-3);
        rings.push_back(f);
    }
    ASSERT_EQ(rings.size(), 2U);
    const FeaturelessMesh result = without(read->mesh, rings);
    EXPECT_EQ(result.removed.size(), 2U);
    for (const KeptFeature& kept : result.kept) ADD_FAILURE() << kept.reason;
    expect_rest_is_the_same(read->mesh, result);
    EXPECT_TRUE(inspect(result.mesh).closed);
    EXPECT_EQ(inspect(result.mesh).genus, inspect(read->mesh).genus);
    EXPECT_EQ(fillets_of(result.mesh).size(), 4U);
}

TEST(FilletsTest, FindsAllThatTheCrankshaftWasMadeWith) {
    const auto read = read_mesh_file(test::data_file("crankshaft.stl"), {});
    ASSERT_TRUE(read) << read.error().message;
    std::size_t of_journals = 0, of_flange = 0;
    for (const ShapeFeature& f : fillets_of(read->mesh)) {
        of_journals += std::abs(f.diameter - 7) < 0.001 ? 1 : 0;
        of_flange += std::abs(f.diameter - 4) < 0.001 ? 1 : 0;
        EXPECT_EQ(f.sides[0].front(), f.sides[0].back());
        EXPECT_NEAR(std::abs(f.axis.z()), 1, 1e-5);
    }
    EXPECT_EQ(of_journals, 17U);
    EXPECT_EQ(of_flange, 2U);
}

}  // namespace
}  // namespace vsplit
