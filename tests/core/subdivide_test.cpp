#include "vsplit/subdivide/subdivide.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "tests/core/meshes.h"
#include "vsplit/io/read_mesh.h"
#include "vsplit/mesh/inspect.h"
#include "vsplit/quality/stretch.h"

namespace vsplit {
namespace {

constexpr std::uint32_t kLimit = 10'000'000;

double longest_edge(const TriangleMesh& mesh) { return measure_quality(mesh).size_max; }

/// Each child lies in its parent: its corners are in the parent's plane and inside its sides.
void expect_children_inside_parents(const TriangleMesh& source, const SubdividedMesh& fine) {
    ASSERT_EQ(fine.parent.size(), fine.mesh.faces.size());
    const double slack = 1e-9 * bounding_box(source).diagonal();
    for (std::uint32_t f = 0; f < fine.mesh.face_count(); ++f) {
        const Triangle& t = source.faces[fine.parent[f]];
        const Vec3& a = source.positions[t[0]];
        const Vec3 ab = source.positions[t[1]] - a;
        const Vec3 ac = source.positions[t[2]] - a;
        Eigen::Matrix<double, 3, 2> sides;
        sides << ab, ac;
        for (const std::uint32_t v : fine.mesh.faces[f]) {
            const Vec3 offset = fine.mesh.positions[v] - a;
            const Eigen::Vector2d barycentric = sides.colPivHouseholderQr().solve(offset);
            ASSERT_LE((sides * barycentric - offset).norm(), slack) << "face " << f << " leaves its parent's plane";
            ASSERT_GE(barycentric.minCoeff(), -1e-6);
            ASSERT_LE(barycentric.sum(), 1 + 1e-6);
        }
    }
}

void expect_same_surface(const TriangleMesh& source, const SubdividedMesh& fine) {
    const double area = surface_area(source);
    EXPECT_NEAR(surface_area(fine.mesh), area, 1e-9 * area);
    const double box = bounding_box(source).diagonal();
    EXPECT_NEAR(enclosed_volume(fine.mesh), enclosed_volume(source), 1e-9 * box * box * box);
    const MeshReport before = inspect(source);
    const MeshReport after = inspect(fine.mesh);
    EXPECT_TRUE(after.closed);
    EXPECT_EQ(after.components, before.components);
    EXPECT_EQ(after.genus, before.genus);
    expect_children_inside_parents(source, fine);
}

TEST(SubdivideTest, ToSizeKeepsTheSurfaceAndShortensEveryEdge) {
    const ExecutionContext context;
    for (const test::NamedMesh& m : test::small_meshes()) {
        SCOPED_TRACE(m.name);
        const double size = 0.3 * longest_edge(m.mesh);
        const auto fine = subdivide_to_size(m.mesh, size, kLimit, context);
        ASSERT_TRUE(fine) << fine.error().message;
        EXPECT_LE(longest_edge(fine->mesh), size);
        expect_same_surface(m.mesh, *fine);
        EXPECT_EQ(predict_subdivision(m.mesh, size, kLimit), fine->mesh.face_count());
    }
}

TEST(SubdivideTest, ToSizeLeavesAFineMeshAlone) {
    const ExecutionContext context;
    const TriangleMesh mesh = test::icosphere(2);
    const auto fine = subdivide_to_size(mesh, 10, kLimit, context);
    ASSERT_TRUE(fine);
    EXPECT_EQ(fine->mesh, mesh);
}

TEST(SubdivideTest, OneToFourKeepsTheSurfaceAndTheStretchOfEachFace) {
    const ExecutionContext context;
    for (const test::NamedMesh& m : test::small_meshes()) {
        SCOPED_TRACE(m.name);
        const auto fine = subdivide_one_to_four(m.mesh, 2, kLimit, context);
        ASSERT_TRUE(fine) << fine.error().message;
        ASSERT_EQ(fine->mesh.face_count(), 16 * m.mesh.face_count());
        expect_same_surface(m.mesh, *fine);
        const auto stretch_of_face = [](const TriangleMesh& mesh, std::uint32_t f) {
            const Triangle& t = mesh.faces[f];
            return stretch(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]);
        };
        for (std::uint32_t f = 0; f < fine->mesh.face_count(); ++f) {
            ASSERT_NEAR(stretch_of_face(fine->mesh, f), stretch_of_face(m.mesh, fine->parent[f]), 1e-9);
        }
    }
}

TEST(SubdivideTest, PredictsRealPartsExactly) {
    const ExecutionContext context;
    for (const auto& path : test::own_closed_meshes()) {
        SCOPED_TRACE(path.string());
        const auto read = read_mesh_file(path, {});
        ASSERT_TRUE(read) << read.error().message;
        const double size = 0.02 * bounding_box(read->mesh).diagonal();
        const auto fine = subdivide_to_size(read->mesh, size, kLimit, context);
        ASSERT_TRUE(fine) << fine.error().message;
        EXPECT_EQ(predict_subdivision(read->mesh, size, kLimit), fine->mesh.face_count());
        EXPECT_NEAR(surface_area(fine->mesh), surface_area(read->mesh), 1e-9 * surface_area(read->mesh));
    }
}

TEST(SubdivideTest, OverTheLimitNamesASizeThatFits) {
    const ExecutionContext context;
    const TriangleMesh mesh = test::cube();
    const auto refused = subdivide_to_size(mesh, 1e-4, 5000, context);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().cause, Cause::kLimitExceeded);
    EXPECT_EQ(refused.error().field, "subdivision_size");
    const std::string& message = refused.error().message;
    const std::size_t at = message.find("size of ");
    ASSERT_NE(at, std::string::npos) << message;
    const double named = std::stod(message.substr(at + 8));
    EXPECT_TRUE(subdivide_to_size(mesh, named, 5000, context)) << message;
}

TEST(SubdivideTest, EdgesBelowRoundingEndAtTheLimit) {
    const ExecutionContext context;
    const auto refused = subdivide_to_size(test::cube(), 1e-300, 1000, context);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().cause, Cause::kLimitExceeded);
}

TEST(SubdivideTest, OneToFourOverTheLimitNamesHowOftenFits) {
    const ExecutionContext context;
    const auto refused = subdivide_one_to_four(test::cube(), 6, 1000, context);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().cause, Cause::kLimitExceeded);
    EXPECT_NE(refused.error().message.find("3 fit"), std::string::npos) << refused.error().message;
    EXPECT_TRUE(subdivide_one_to_four(test::cube(), 3, 1000, context));
}

TEST(SubdivideTest, RefusesSizesThatAreNone) {
    const ExecutionContext context;
    for (const double size : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        const auto refused = subdivide_to_size(test::cube(), size, kLimit, context);
        ASSERT_FALSE(refused) << size;
        EXPECT_EQ(refused.error().cause, Cause::kInvalidOption);
    }
}

TEST(SubdivideTest, StopsWhenCancelled) {
    ExecutionContext context;
    context.cancel();
    const auto stopped = subdivide_to_size(test::cube(), 0.01, kLimit, context);
    ASSERT_FALSE(stopped);
    EXPECT_EQ(stopped.error().cause, Cause::kCancelled);
}

TEST(SubdivideTest, StopsWhenItsTimeIsOver) {
    ExecutionContext context;
    context.cancel_at(ExecutionContext::Clock::now() + std::chrono::milliseconds(20));
    EXPECT_FALSE(context.late());
    const auto stopped = subdivide_to_size(test::cube(), 1e-4, std::numeric_limits<std::uint32_t>::max(), context);
    ASSERT_FALSE(stopped);
    EXPECT_EQ(stopped.error().cause, Cause::kCancelled);
    EXPECT_TRUE(context.late());
}

TEST(SubdivideTest, AsksWithTheNumberOfFacesBeforeItMakesThem) {
    std::vector<std::uint32_t> asked;
    const FaceLimit willing(kLimit, [&](std::uint32_t faces) {
        asked.push_back(faces);
        return Status(Done{});
    });
    const auto sized = subdivide_to_size(test::cube(), 0.3, willing, ExecutionContext());
    const auto quartered = subdivide_one_to_four(test::cube(), 2, willing, ExecutionContext());
    ASSERT_TRUE(sized && quartered);
    EXPECT_EQ(asked, (std::vector<std::uint32_t>{sized->mesh.face_count(), quartered->mesh.face_count()}));

    const FaceLimit unwilling(kLimit, [](std::uint32_t) { return Status(Error{Cause::kLimitExceeded, "no room", ""}); });
    EXPECT_EQ(subdivide_to_size(test::cube(), 0.3, unwilling, ExecutionContext()).error().message, "no room");
    EXPECT_EQ(subdivide_one_to_four(test::cube(), 2, unwilling, ExecutionContext()).error().message, "no room");
}

}  // namespace
}  // namespace vsplit
