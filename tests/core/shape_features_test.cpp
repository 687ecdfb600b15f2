#include "vsplit/shapes/shape_features.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "tests/core/drilled_plate.h"
#include "tests/core/meshes.h"
#include "vsplit/io/read_mesh.h"
#include "vsplit/method/improve.h"
#include "vsplit/mrr/progressive_mesh.h"

namespace vsplit {
namespace {

using Kind = ShapeFeature::Kind;

std::vector<ShapeFeature> features_of(const TriangleMesh& mesh) {
    const auto features = list_features(mesh);
    EXPECT_TRUE(features) << features.error().message;
    return features ? *features : std::vector<ShapeFeature>{};
}

/// The feature whose axis goes through the middle of a square of a plate of pitch 10.
const ShapeFeature* feature_at(const std::vector<ShapeFeature>& all, std::uint32_t column, std::uint32_t row) {
    for (const ShapeFeature& f : all) {
        if ((f.centre.head<2>() - Eigen::Vector2d(10 * column + 5, 10 * row + 5)).norm() < 0.01) return &f;
    }
    return nullptr;
}

TEST(ShapeFeaturesTest, FindsFortyHolesOfAPlate) {
    const double thickness = 4;
    const std::vector<test::Drilling> drillings = test::forty_drillings(thickness);
    const TriangleMesh mesh = test::shuffled(test::drilled_plate(8, 10, thickness, drillings), 7);
    const std::vector<ShapeFeature> all = features_of(mesh);
    ASSERT_EQ(all.size(), 40U);
    for (std::uint32_t i = 0; i < 40; ++i) {
        const ShapeFeature* found = feature_at(all, i % 8, i / 8);
        ASSERT_TRUE(found) << i;
        const bool blind = drillings[i].depth < thickness;
        EXPECT_EQ(found->kind, blind ? Kind::kBlindHole : Kind::kThroughHole) << i;
        EXPECT_NEAR(found->diameter, drillings[i].diameter, 0.01 * drillings[i].diameter) << i;
        EXPECT_NEAR(found->depth, drillings[i].depth, 1e-9) << i;
        EXPECT_NEAR(std::abs(found->axis.z()), 1, 1e-9) << i;
        if (blind) {
            EXPECT_LT(found->axis.z(), 0) << i;
        }
        EXPECT_EQ(found->faces.size(), 2 * drillings[i].sides + (blind ? drillings[i].sides - 2 : 0)) << i;
    }
}

TEST(ShapeFeaturesTest, RefusesAMeshThatIsInsideOut) {
    TriangleMesh mesh = test::cube();
    for (Triangle& face : mesh.faces) std::swap(face[1], face[2]);
    const auto found = list_features(mesh, {});
    ASSERT_FALSE(found);
    EXPECT_EQ(found.error().cause, Cause::kNonManifold);
    EXPECT_NE(found.error().message.find("inside out"), std::string::npos) << found.error().message;
}

TEST(ShapeFeaturesTest, FindsABossAndItsHeight) {
    const TriangleMesh mesh = test::drilled_plate(1, 10, 3, {{4, -2.5, 32}});
    const std::vector<ShapeFeature> all = features_of(mesh);
    ASSERT_EQ(all.size(), 1U);
    EXPECT_EQ(all[0].kind, Kind::kBoss);
    EXPECT_NEAR(all[0].diameter, 4, 1e-9);
    EXPECT_NEAR(all[0].depth, 2.5, 1e-9);
    EXPECT_GT(all[0].axis.z(), 0.999);
    EXPECT_NEAR(all[0].centre.z(), 1.25, 1e-9);
}

TEST(ShapeFeaturesTest, FacesOfFeaturesAreApartAndInOrder) {
    const std::vector<ShapeFeature> all = features_of(test::drilled_plate(8, 10, 4, test::forty_drillings(4)));
    std::set<std::uint32_t> seen;
    for (std::uint32_t id = 0; id < all.size(); ++id) {
        EXPECT_EQ(all[id].id, id);
        if (id > 0) {
            EXPECT_LT(all[id - 1].faces.front(), all[id].faces.front());
        }
        for (const std::uint32_t f : all[id].faces) EXPECT_TRUE(seen.insert(f).second);
    }
}

TEST(ShapeFeaturesTest, OtherShapesHaveNone) {
    // A cylinder on its own is no boss, a square hole no round one.
    for (const TriangleMesh& mesh : {test::cube(), test::sliver_cylinder(32, 3), test::icosphere(2), test::torus(24, 12),
                                     test::plate_with_holes(3), test::bumpy_sphere(3, 0.02, 5)})
        EXPECT_TRUE(features_of(mesh).empty());
}

TEST(ShapeFeaturesTest, FewSidesNeedALargerAngle) {
    const TriangleMesh mesh = test::drilled_plate(1, 10, 3, {{4, 3, 8}});
    EXPECT_TRUE(features_of(mesh).empty());
    const auto found = list_features(mesh, {50});
    ASSERT_TRUE(found);
    EXPECT_EQ(found->size(), 1U);
}

TEST(ShapeFeaturesTest, AnAngleOfAWholeTurnsShareIsEnough) {
    // Nine sides bend by 40 degrees each, but for rounding.
    TriangleMesh mesh = test::drilled_plate(1, 10, 3, {{4, 3, 36}});
    EXPECT_EQ(list_features(mesh, {10})->size(), 1U);
    for (Vec3& p : mesh.positions) p = p.cast<float>().cast<double>();
    EXPECT_EQ(list_features(mesh, {10})->size(), 1U);
    EXPECT_TRUE(list_features(mesh, {9.9})->empty());
}

TEST(ShapeFeaturesTest, FindsHolesThatAToleranceMadeUneven) {
    // Holes of 1 to 4.9 by default: the tolerance is 0.094, so vertices are off their circle by up to 10 % of the radius.
    std::vector<test::Drilling> drillings;
    for (std::uint32_t i = 0; i < 40; ++i) drillings.push_back({1 + 0.1 * i, 5, 24});
    ImproveOptions options;
    options.subdivision_size = 1;
    const ExecutionContext context;
    const auto improved = improve(test::drilled_plate(8, 10, 5, drillings), options, {}, context);
    ASSERT_TRUE(improved) << improved.error().message;
    const std::vector<ShapeFeature> all = features_of(mesh_at(improved->mrr, improved->mrr.level_for(improved->faces)));
    for (std::uint32_t i = 0; i < 40; ++i) {
        const double diameter = drillings[i].diameter;
        const Eigen::Vector2d middle(10 * (i % 8) + 5, 10 * (i / 8) + 5);
        const auto found = std::find_if(all.begin(), all.end(), [&](const ShapeFeature& f) {
            return f.kind == Kind::kThroughHole && (f.centre.head<2>() - middle).norm() < 0.02;
        });
        if (diameter < 2) continue;  // seven sides and fewer are left of these
        ASSERT_NE(found, all.end()) << diameter;
        EXPECT_NEAR(found->diameter, diameter, (diameter < 2.6 ? 0.02 : 0.01) * diameter);
        EXPECT_NEAR(found->depth, 5, 0.01);
    }
}

TEST(ShapeFeaturesTest, DiametersHoldInMeshesThatWereImproved) {
    for (const std::uint32_t sides : {24U, 48U}) {
        for (const double tolerance : {0.02, 0.05}) {
            std::vector<test::Drilling> drillings;
            for (std::uint32_t i = 0; i < 40; ++i) drillings.push_back({2 + 0.1 * i, 5, sides});
            ImproveOptions options;
            options.subdivision_size = 1;
            options.tolerance = tolerance;
            const ExecutionContext context;
            const auto improved = improve(test::drilled_plate(8, 10, 5, drillings), options, {}, context);
            ASSERT_TRUE(improved) << improved.error().message;
            std::size_t found = 0;
            for (const ShapeFeature& f : features_of(mesh_at(improved->mrr, improved->mrr.level_for(improved->faces)))) {
                const auto column = static_cast<std::uint32_t>(f.centre.x() / 10),
                           row = static_cast<std::uint32_t>(f.centre.y() / 10);
                const double diameter = drillings[8 * row + column].diameter;
                EXPECT_NEAR(f.diameter, diameter, 0.01 * diameter) << sides << " sides, within " << tolerance;
                ++found;
            }
            EXPECT_EQ(found, 40U);
        }
    }
}

TEST(ShapeFeaturesTest, AnOvalIsNoHole) {
    TriangleMesh mesh = test::drilled_plate(1, 10, 3, {{4, 3, 48}});
    for (Vec3& p : mesh.positions) p.x() *= 1.2;
    EXPECT_TRUE(features_of(mesh).empty());
}

TEST(ShapeFeaturesTest, SaysWhatItDoesNotTake) {
    const auto open = list_features(test::square(3));
    ASSERT_FALSE(open);
    EXPECT_EQ(open.error().cause, Cause::kOpenMesh);
    TriangleMesh torn = test::cube();
    torn.faces.push_back(torn.faces.front());
    ASSERT_FALSE(list_features(torn));
    EXPECT_EQ(list_features(torn).error().cause, Cause::kNonManifold);
    for (const double angle : {0.0, -1.0, 180.0, std::nan("")}) {
        const auto refused = list_features(test::cube(), {angle});
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.error().field, "angle");
    }
}

TEST(ShapeFeaturesTest, FindsTheOilHolesOfTheCrankshaft) {
    const auto read = read_mesh_file(test::data_file("crankshaft.stl"), {});
    ASSERT_TRUE(read) << read.error().message;
    // Four drillings of 9 from a main journal to a pin; the bore of the pin cuts each in two.
    std::size_t oil_holes = 0;
    for (const ShapeFeature& f : features_of(read->mesh)) {
        if (std::abs(f.diameter - 9) > 0.09 || std::abs(f.axis.x()) < 0.9) continue;
        EXPECT_EQ(f.kind, Kind::kThroughHole);
        ++oil_holes;
    }
    EXPECT_EQ(oil_holes, 8U);
}

}  // namespace
}  // namespace vsplit
