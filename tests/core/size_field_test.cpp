#include "vsplit/sizing/size_field.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/half_edges.h"
#include "mesh/spatial_order.h"
#include "tests/core/meshes.h"
#include "tests/core/random.h"
#include "vsplit/features/creases.h"
#include "vsplit/io/read_mesh.h"
#include "vsplit/mesh/inspect.h"
#include "vsplit/method/method_options.h"

namespace vsplit {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
const Vec3 kOrigin = Vec3::Zero();
constexpr std::uint32_t kLimit = 5'000'000;

std::vector<SharpEdge> creases_of(const TriangleMesh& mesh) { return find_creases(mesh, face_normals(mesh), {}); }

SizeField field_of(const TriangleMesh& mesh, const SizingOptions& options) {
    auto field = make_size_field(mesh, options, creases_of(mesh));
    EXPECT_TRUE(field) << field.error().message;
    return field ? *std::move(field) : SizeField();
}

SubdividedMesh subdivided(const TriangleMesh& mesh, const SizeField& field) {
    const ExecutionContext context;
    auto fine = subdivide_to_sizes(mesh, field, kLimit, context);
    EXPECT_TRUE(fine) << fine.error().message;
    return fine ? *std::move(fine) : SubdividedMesh();
}

void expect_graded(const TriangleMesh& mesh, const std::vector<double>& sizes, double gradation) {
    ASSERT_EQ(sizes.size(), mesh.positions.size());
    for (HalfEdge h = 0; h < mesh.faces.size() * 3; ++h) {
        const std::uint32_t a = origin(mesh, h);
        const std::uint32_t b = origin(mesh, next(h));
        if (!std::isfinite(sizes[a])) continue;
        const double length = (mesh.positions[a] - mesh.positions[b]).norm();
        ASSERT_LE(sizes[a], sizes[b] + gradation * length * (1 + 1e-12) + 1e-12);
    }
}

double longest_edge_near(const TriangleMesh& mesh, const Vec3& point, double radius) {
    double longest = 0;
    for (const Triangle& t : mesh.faces) {
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec3& a = mesh.positions[t[i]];
            const Vec3& b = mesh.positions[t[(i + 1) % 3]];
            if (std::min((a - point).norm(), (b - point).norm()) <= radius) longest = std::max(longest, (a - b).norm());
        }
    }
    return longest;
}

TEST(SizeFieldTest, WithoutOptionsNothingBounds) {
    const TriangleMesh mesh = test::cube();
    const SizeField field = field_of(mesh, {});
    for (const double size : field.vertex_sizes()) EXPECT_EQ(size, kInfinity);
    EXPECT_EQ(subdivided(mesh, field).mesh, mesh);
}

TEST(SizeFieldTest, GradesLikeBruteForce) {
    const TriangleMesh mesh = test::bumpy_sphere(2, 0.05, 4);
    test::Random random(5);
    std::vector<double> asked(mesh.positions.size());
    for (double& size : asked) size = random.below(4) == 0 ? random.uniform(0.01, 1) : kInfinity;
    // Relaxation to the fixed point.
    std::vector<double> expected = asked;
    for (bool changed = true; changed;) {
        changed = false;
        for (HalfEdge h = 0; h < mesh.faces.size() * 3; ++h) {
            const std::uint32_t a = origin(mesh, h);
            const std::uint32_t b = origin(mesh, next(h));
            const double length = (mesh.positions[a] - mesh.positions[b]).norm();
            if (expected[a] + 0.3 * length < expected[b]) {
                expected[b] = expected[a] + 0.3 * length;
                changed = true;
            }
        }
    }
    EXPECT_EQ(graded_sizes(mesh, asked, 0.3), expected);
    SizingOptions options;
    options.field = asked;
    for (double& size : options.field) size = std::isfinite(size) ? size : 0;  // 0 is no bound
    EXPECT_EQ(field_of(mesh, options).vertex_sizes(), expected);
}

TEST(SizeFieldTest, AnUnboundedComponentStaysUnbounded) {
    const TriangleMesh mesh = test::joined(test::icosphere(1), test::icosphere(1), Vec3(5, 0, 0));
    SizingOptions options;
    options.field.assign(mesh.positions.size(), 0);
    options.field[0] = 0.1;
    const SizeField field = field_of(mesh, options);
    EXPECT_TRUE(std::isfinite(field.vertex_sizes()[41]));
    EXPECT_EQ(field.vertex_sizes()[42], kInfinity);
    EXPECT_EQ(sizes_on(subdivided(mesh, field), mesh, field)[42], kInfinity);
}

TEST(SizeFieldTest, ASmallSphereInALargeFaceCounts) {
    const TriangleMesh mesh = test::cube();
    SizingOptions options;
    const Vec3 place(0.7, 0.4, 1);  // inside a face of the top, far from every vertex
    options.spheres = {{place, 0.02, 0.01}};
    const SizeField field = field_of(mesh, options);
    const SubdividedMesh fine = subdivided(mesh, field);
    EXPECT_LE(longest_edge_near(fine.mesh, place, 0.02), 0.01 / (1 - 0.3 / std::sqrt(3.0)));
    EXPECT_GT(longest_edge_near(fine.mesh, Vec3(0, 0, 0), 0.1), 0.2) << "far away edges stay long";
    EXPECT_LT(fine.mesh.face_count(), 6000U) << "a uniform mesh of that size has 260,000";
    expect_graded(fine.mesh, sizes_on(fine, mesh, field), 0.3);
}

TEST(SizeFieldTest, APointIsASphereToo) {
    const TriangleMesh mesh = test::cube();
    SizingOptions options;
    options.spheres = {{{0.3, 0.6, 0}, 0, 0.002}};
    options.gradation = 1;
    const SubdividedMesh fine = subdivided(mesh, field_of(mesh, options));
    double nearest = kInfinity;
    for (const Triangle& t : fine.mesh.faces) {
        const Vec3 middle = (fine.mesh.positions[t[0]] + fine.mesh.positions[t[1]] + fine.mesh.positions[t[2]]) / 3;
        const double size = (fine.mesh.positions[t[0]] - fine.mesh.positions[t[1]]).norm();
        if ((middle - options.spheres[0].center).norm() < 0.004) nearest = std::min(nearest, size);
    }
    EXPECT_LE(nearest, 0.002 / (1 - 1 / std::sqrt(3.0)));
}

TEST(SizeFieldTest, ABoxIsRefinedInsideAndGradesOutside) {
    const TriangleMesh mesh = test::cube();
    SizingOptions options;
    options.boxes = {{{0.2, 0.2, 0.5}, {0.4, 0.6, 1.5}, 0.03}};
    const SizeField field = field_of(mesh, options);
    EXPECT_DOUBLE_EQ(field.size_of_shapes({0.3, 0.3, 1}), 0.03);
    EXPECT_DOUBLE_EQ(field.size_of_shapes({0.3, 0.9, 1}), 0.03 + 0.3 * 0.3);
    EXPECT_DOUBLE_EQ(field.size_of_shapes({0, 0.2, 0}), 0.03 + 0.3 * std::hypot(0.2, 0.5));
    const SubdividedMesh fine = subdivided(mesh, field);
    for (const Triangle& t : fine.mesh.faces) {
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec3& a = fine.mesh.positions[t[i]];
            const Vec3& b = fine.mesh.positions[t[(i + 1) % 3]];
            const double allowed = std::min(field.size_of_shapes(a), field.size_of_shapes(b));
            ASSERT_LE((a - b).norm(), allowed);
        }
    }
}

TEST(SizeFieldTest, SubdividingKeepsTheSurfaceAndIsPredictedExactly) {
    for (const test::NamedMesh& m : test::small_meshes()) {
        SCOPED_TRACE(m.name);
        const BoundingBox box = bounding_box(m.mesh);
        SizingOptions options;
        options.spheres = {{m.mesh.positions[0], 0.1 * box.diagonal(), 0.02 * box.diagonal()}};
        options.field.assign(m.mesh.positions.size(), 0.2 * box.diagonal());
        const SizeField field = field_of(m.mesh, options);
        const SubdividedMesh fine = subdivided(m.mesh, field);
        EXPECT_EQ(predict_subdivision(m.mesh, field, kLimit), fine.mesh.face_count());
        EXPECT_EQ(predict_subdivision(m.mesh, field, 10), 11U);
        const double area = surface_area(m.mesh);
        EXPECT_NEAR(surface_area(fine.mesh), area, 1e-9 * area);
        EXPECT_NEAR(enclosed_volume(fine.mesh), enclosed_volume(m.mesh), 1e-9 * std::pow(box.diagonal(), 3));
        EXPECT_TRUE(inspect(fine.mesh).closed);
    }
}

TEST(SizeFieldTest, ASizeThatIsTheSameEverywhereIsSubdivideToSize) {
    const ExecutionContext context;
    for (const test::NamedMesh& m : test::small_meshes()) {
        SCOPED_TRACE(m.name);
        SizingOptions options;
        options.max_size = 0.3 * measure_quality(m.mesh).size_max;
        const auto uniform = subdivide_to_size(m.mesh, *options.max_size, kLimit, context);
        ASSERT_TRUE(uniform);
        const SubdividedMesh fine = subdivided(m.mesh, field_of(m.mesh, options));
        EXPECT_EQ(fine.mesh, uniform->mesh);
        EXPECT_EQ(fine.parent, uniform->parent);
    }
}

TEST(SizeFieldTest, SizesOnASubdivisionAreLinearAndGradedInAnyOrder) {
    const TriangleMesh mesh = test::torus(24, 12);
    SizingOptions options;
    for (const Vec3& p : mesh.positions) options.field.push_back(0.2 + 0.1 * (p.x() + 1.4));  // linear, and gentler than 0.3
    const SizeField field = field_of(mesh, options);
    SubdividedMesh fine = subdivided(mesh, field);
    ASSERT_GT(fine.mesh.face_count(), mesh.face_count());
    for (const bool ordered : {false, true}) {
        if (ordered) order_spatially(fine);
        const std::vector<double> sizes = sizes_on(fine, mesh, field);
        for (std::uint32_t v = 0; v < fine.mesh.vertex_count(); ++v) {
            EXPECT_NEAR(sizes[v], 0.2 + 0.1 * (fine.mesh.positions[v].x() + 1.4), 1e-9);
        }
    }
}

TEST(SizeFieldTest, SizesOnRealPartsKeepEveryPromise) {
    for (const auto& path : test::own_closed_meshes()) {
        SCOPED_TRACE(path.string());
        const auto read = read_mesh_file(path, {});
        ASSERT_TRUE(read);
        const TriangleMesh& mesh = read->mesh;
        const BoundingBox box = bounding_box(mesh);
        SizingOptions options;
        options.spheres = {{(box.min + box.max) / 2, 0.1 * box.diagonal(), 0.01 * box.diagonal()}};
        options.chord_error = 1e-3 * box.diagonal();
        options.min_size = 0.015 * box.diagonal();
        options.max_size = 0.05 * box.diagonal();
        const SizeField field = field_of(mesh, options);
        SubdividedMesh fine = subdivided(mesh, field);
        order_spatially(fine);
        const std::vector<double> sizes = sizes_on(fine, mesh, field);
        expect_graded(fine.mesh, sizes, options.gradation);
        for (std::size_t v = 0; v < sizes.size(); ++v) {
            ASSERT_LE(sizes[v], *options.max_size * (1 + 1e-12));
            ASSERT_GE(sizes[v], *options.min_size * (1 - 1e-12));
            ASSERT_LE(sizes[v], field.size_of_shapes(fine.mesh.positions[v]));
        }
    }
}

/// Curvature of vertices, and what it should be.
void expect_curvature(const TriangleMesh& mesh, double least, double most) {
    const std::vector<double> curvature = largest_curvature(mesh, creases_of(mesh));
    for (std::size_t v = 0; v < curvature.size(); ++v) {
        ASSERT_GE(curvature[v], least) << v;
        ASSERT_LE(curvature[v], most) << v;
    }
}

TEST(SizeFieldTest, CurvatureIsThatOfSphereTorusAndCylinder) {
    expect_curvature(test::icosphere(4), 0.95, 1.05);
    expect_curvature(test::torus(120, 60), 2.4, 2.6);  // 1 / 0.4, the small radius
    expect_curvature(test::cube(), 0, 0);              // creases are no curvature
    expect_curvature(test::sliver_cylinder(64, 20), 0.99, 1.01);
}

TEST(SizeFieldTest, ChordsKeepToTheirError) {
    const double radius = 1;
    SizingOptions options;
    options.chord_error = 1e-3;
    const SizeField field = field_of(test::icosphere(4), options);
    for (const double size : field.vertex_sizes()) {
        const double sagitta = radius - std::sqrt(radius * radius - size * size / 4);
        EXPECT_NEAR(sagitta, 1e-3, 5e-5);
    }
}

TEST(SizeFieldTest, ChordErrorHasAFloorForRadiiBelowIt) {
    TriangleMesh tiny = test::icosphere(2);
    for (Vec3& p : tiny.positions) p *= 1e-6;
    SizingOptions options;
    options.chord_error = 1e-3;
    const SizeField field = field_of(tiny, options);
    for (const double size : field.vertex_sizes()) EXPECT_GE(size, 2.8e-3);
}

TEST(SizeFieldTest, OverTheLimitNamesAMinSizeThatFits) {
    const TriangleMesh mesh = test::cube();
    SizingOptions options;
    options.max_size = 1e-4;
    const ExecutionContext context;
    const auto refused = subdivide_to_sizes(mesh, field_of(mesh, options), 5000, context);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().cause, Cause::kLimitExceeded);
    EXPECT_EQ(refused.error().field, "sizing");
    const std::string& message = refused.error().message;
    const std::size_t at = message.find("no size under ");
    ASSERT_NE(at, std::string::npos) << message;
    options.min_size = options.max_size = std::stod(message.substr(at + 14));
    EXPECT_TRUE(subdivide_to_sizes(mesh, field_of(mesh, options), 5000, context)) << message;
    ExecutionContext stopped;
    stopped.cancel();
    SizingOptions endless;
    endless.max_size = 1e-9;
    EXPECT_EQ(subdivide_to_sizes(mesh, field_of(mesh, endless), kLimit, stopped).error().cause, Cause::kCancelled);
    EXPECT_EQ(subdivide_to_sizes(mesh, field_of(mesh, options), 5000, stopped).error().cause, Cause::kCancelled);
}

void expect_refused(const SizingOptions& sizing, const std::string& field, const std::string& part) {
    ControlOptions options;
    options.sizing = sizing;
    options.max_size = 50;
    const Status status = check_options(options);
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().cause, Cause::kInvalidOption);
    EXPECT_EQ(status.error().field, field);
    EXPECT_NE(status.error().message.find(part), std::string::npos) << status.error().message;
    EXPECT_NE(status.error().message.find("; accepted is "), std::string::npos) << status.error().message;
    ImproveOptions improve;
    improve.sizing = sizing;
    const Status same = check_options(improve);
    ASSERT_FALSE(same);
    EXPECT_EQ(same.error().message, status.error().message);
}

TEST(SizingOptionsTest, RefusesWhatIsWrong) {
    for (const double wrong : {0.0, -1.0, kNan, kInfinity}) {
        SCOPED_TRACE(wrong);
        expect_refused({.spheres = {{kOrigin, 1, 1}, {kOrigin, 1, wrong}}}, "sizing.spheres", "sizing.spheres[1].size is ");
        expect_refused({.boxes = {{kOrigin, kOrigin, wrong}}}, "sizing.boxes", "sizing.boxes[0].size is ");
        expect_refused({.chord_error = wrong}, "sizing.chord_error", "sizing.chord_error is ");
        expect_refused({.gradation = wrong}, "sizing.gradation", "more than 0, at most 1");
        expect_refused({.min_size = wrong}, "sizing.min_size", "sizing.min_size is ");
        expect_refused({.max_size = wrong}, "sizing.max_size", "sizing.max_size is ");
        if (wrong != 0) expect_refused({.spheres = {{kOrigin, wrong, 1}}}, "sizing.spheres", "sizing.spheres[0].radius is ");
        if (wrong != 0) expect_refused({.field = {0, 1, wrong}}, "sizing.field", "sizing.field[2] is ");
    }
    expect_refused({.spheres = {{{0, kNan, 0}, 1, 1}}}, "sizing.spheres", "sizing.spheres[0].center is (0, nan, 0)");
    expect_refused({.boxes = {{{0, 2, 0}, {1, 1, 1}, 1}}}, "sizing.boxes", "nowhere less than min");
    SizingOptions many;
    many.spheres.assign(600, {kOrigin, 1, 1});
    many.boxes.assign(401, {kOrigin, kOrigin, 1});
    expect_refused(many, "sizing.spheres", "the number of spheres and boxes is 1001");
    expect_refused({.gradation = 1.5}, "sizing.gradation", "sizing.gradation is 1.5");
}

TEST(SizingOptionsTest, RefusesContradictions) {
    expect_refused({.min_size = 2, .max_size = 1}, "sizing.min_size", "at most sizing.max_size, which is 1");
    ControlOptions control;
    control.sizing.emplace().min_size = 5;
    control.max_size = 4;
    const Status status = check_options(control);
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().field, "sizing.min_size");
    EXPECT_NE(status.error().message.find("at most max_size, which is 4"), std::string::npos) << status.error().message;
}

TEST(SizingOptionsTest, TheFieldMustFitTheSource) {
    ImproveOptions options;
    options.sizing.emplace().field = {1, 2, 3};
    const Status status = check_options_on(test::cube(), options);
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().field, "sizing.field");
    EXPECT_NE(status.error().message.find("3 numbers; accepted is one for each of the 8"), std::string::npos);
    options.sizing->field.assign(8, 1);
    EXPECT_TRUE(check_options_on(test::cube(), options));
    EXPECT_FALSE(make_size_field(test::tetrahedron(), *options.sizing, {}));
}

TEST(SizingOptionsTest, MaxSizeOfControlBoundsTheFieldToo) {
    ControlOptions options;
    EXPECT_FALSE(sizing_options(options));
    options.max_size = 3;
    EXPECT_EQ(sizing_options(options)->max_size, 3.0);
    options.sizing.emplace().max_size = 2;
    EXPECT_EQ(sizing_options(options)->max_size, 2.0);
    options.sizing->max_size = 9;
    EXPECT_EQ(sizing_options(options)->max_size, 3.0);
}

}  // namespace
}  // namespace vsplit
