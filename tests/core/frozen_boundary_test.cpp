#include "sizing/frozen_boundary.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "mesh/boundary_loops.h"
#include "tests/core/meshes.h"
#include "tests/core/random.h"
#include "vsplit/mesh/inspect.h"
#include "vsplit/quality/mesh_quality.h"

namespace vsplit::test {
namespace {

constexpr std::uint32_t kMany = 1'000'000;

/// A strip of long faces of all shapes, from equilateral to slivers of a thousandth.
TriangleMesh ragged_strip(std::uint64_t seed) {
    Random random(seed);
    TriangleMesh mesh;
    double below = 0, above = 0;
    for (std::uint32_t n = 0; n < 30; ++n) {
        mesh.positions.emplace_back(below += std::pow(10, random.uniform(-2, 0.5)), 0, 0);
        mesh.positions.emplace_back(above += std::pow(10, random.uniform(-2, 0.5)), std::pow(10, random.uniform(-2, 1)), 0);
        if (n == 0) continue;
        mesh.faces.push_back({2 * n - 2, 2 * n, 2 * n - 1});
        mesh.faces.push_back({2 * n, 2 * n + 1, 2 * n - 1});
    }
    return mesh;
}

std::vector<TriangleMesh> meshes() {
    return {square(1),         square(3),       holed_square(8, 2), open_cylinder(12, 1),
            hemisphere(16, 3), ragged_strip(1), ragged_strip(2),    joined(square(1), cube(), Vec3(3, 0, 0))};
}

/// Boundary edges by the numbers of their vertices, which subdivision keeps.
std::vector<std::pair<std::uint32_t, std::uint32_t>> boundary(const TriangleMesh& mesh) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (const auto& loop : boundary_loops(mesh)) {
        for (const HalfEdge h : loop) edges.emplace_back(origin(mesh, h), origin(mesh, next(h)));
    }
    std::sort(edges.begin(), edges.end());
    return edges;
}

void expect_same_surface(const SubdividedMesh& fine, const TriangleMesh& source) {
    EXPECT_EQ(boundary(fine.mesh), boundary(source));
    EXPECT_TRUE(std::equal(source.positions.begin(), source.positions.end(), fine.mesh.positions.begin()));
    EXPECT_NEAR(surface_area(fine.mesh), surface_area(source), 1e-9 * surface_area(source));
    EXPECT_TRUE(require_manifold(inspect(fine.mesh)));
    EXPECT_EQ(inspect(fine.mesh).components, inspect(source).components);
    EXPECT_EQ(fine.parent.size(), fine.mesh.faces.size());
}

TEST(FrozenBoundaryTest, SplitsInsideOnlyAndEndsOnAnyShape) {
    const ExecutionContext context;
    for (const TriangleMesh& source : meshes()) {
        for (const double size : {2.0, 0.5, 0.1}) {
            const auto fine = subdivide_to_size_inside(source, size, kMany, context);
            ASSERT_TRUE(fine) << fine.error().message;
            expect_same_surface(*fine, source);
        }
        for (const std::uint32_t times : {0U, 1U, 4U}) {
            const auto fine = subdivide_one_to_four_inside(source, times, kMany, context);
            ASSERT_TRUE(fine) << fine.error().message;
            expect_same_surface(*fine, source);
        }
    }
}

TEST(FrozenBoundaryTest, EdgesAreAsShortAsAskedForAwayFromLongBoundaryEdges) {
    const ExecutionContext context;
    for (const TriangleMesh& source : meshes()) {
        double longest = 0;
        for (const auto& [a, b] : boundary(source)) {
            longest = std::max(longest, (source.positions[a] - source.positions[b]).norm());
        }
        const double size = 0.1;
        const auto fine = subdivide_to_size_inside(source, size, kMany, context);
        ASSERT_TRUE(fine);
        std::vector<bool> held(fine->mesh.positions.size(), false);
        for (const auto& [a, b] : boundary(source)) held[a] = held[b] = true;
        for (const Triangle& t : fine->mesh.faces) {
            for (int c = 0; c < 3; ++c) {
                const Vec3& a = fine->mesh.positions[t[c]];
                const Vec3& b = fine->mesh.positions[t[(c + 1) % 3]];
                double least = 1e300;  // distance of both ends to the boundary's vertices
                for (std::uint32_t v = 0; v < source.vertex_count(); ++v) {
                    if (held[v]) least = std::min({least, (source.positions[v] - a).norm(), (source.positions[v] - b).norm()});
                }
                EXPECT_LE((a - b).norm(), std::max(size, longest) * (1 + 1e-12));
                if (least <= 2 * longest) continue;
                EXPECT_LE((a - b).norm(), size * (1 + 1e-9));
            }
        }
    }
    // Far from its boundary there are such edges: the middle of a wide sheet is as fine as without.
    const auto wide = subdivide_to_size_inside(square(8), 0.4, kMany, context);
    const auto all = subdivide_to_size(square(8), 0.4, kMany, context);
    const auto middle = [](const TriangleMesh& mesh) {
        return std::count_if(mesh.positions.begin(), mesh.positions.end(),
                             [](const Vec3& p) { return (p - Vec3(4, 4, 0)).cwiseAbs().maxCoeff() < 1; });
    };
    EXPECT_EQ(middle(wide->mesh), middle(all->mesh));
    EXPECT_LT(wide->mesh.face_count(), all->mesh.face_count());
}

TEST(FrozenBoundaryTest, GoodFacesStayGoodHoweverOften) {
    const ExecutionContext context;
    TriangleMesh equilateral;
    equilateral.positions = {{0, 0, 0}, {1, 0, 0}, {0.5, std::sqrt(0.75), 0}};
    equilateral.faces = {{0, 1, 2}};
    for (const TriangleMesh& source : {equilateral, square(1), square(4), open_cylinder(12, 4)}) {
        for (const std::uint32_t times : {1U, 3U, 5U}) {
            const auto fine = subdivide_one_to_four_inside(source, times, kMany, context);
            EXPECT_GE(measure_quality(fine->mesh).stretch_min, 0.3) << source.face_count() << " faces, " << times << " times";
        }
        for (const double size : {0.3, 0.05, 0.01}) {
            const auto fine = subdivide_to_size_inside(source, size, kMany, context);
            EXPECT_GE(measure_quality(fine->mesh).stretch_min, 0.3) << source.face_count() << " faces to " << size;
        }
    }
}

TEST(FrozenBoundaryTest, AClosedMeshIsSubdividedAsAlways) {
    const ExecutionContext context;
    EXPECT_EQ(subdivide_to_size_inside(cube(), 0.3, kMany, context)->mesh, subdivide_to_size(cube(), 0.3, kMany, context)->mesh);
    EXPECT_EQ(subdivide_one_to_four_inside(cube(), 2, kMany, context)->mesh,
              subdivide_one_to_four(cube(), 2, kMany, context)->mesh);
}

TEST(FrozenBoundaryTest, TooManyFacesAreRefusedWithASizeThatFits) {
    const ExecutionContext context;
    const auto refused = subdivide_to_size_inside(square(8), 0.01, 2000, context);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().cause, Cause::kLimitExceeded);
    const std::string& message = refused.error().message;
    const double fits = std::stod(message.substr(message.find("size of ") + 8));
    const auto fitting = subdivide_to_size_inside(square(8), fits, 2000, context);
    ASSERT_TRUE(fitting) << message;
    EXPECT_GT(fitting->mesh.face_count(), 500U);
    EXPECT_EQ(subdivide_to_size_inside(square(8), 0, 2000, context).error().cause, Cause::kInvalidOption);
    EXPECT_EQ(subdivide_one_to_four_inside(square(8), 13, 2000, context).error().cause, Cause::kInvalidOption);
    EXPECT_EQ(subdivide_one_to_four_inside(square(8), 4, 2000, context).error().cause, Cause::kLimitExceeded);
}

TEST(FrozenBoundaryTest, TooManyFacesOfSizesAreRefusedWithALeastSizeThatFits) {
    const ExecutionContext context;
    for (const std::uint32_t cells : {8U, 16U}) {
        const TriangleMesh mesh = square(cells);
        SizingOptions sizing;
        sizing.spheres = {{Vec3(cells / 2.0, cells / 2.0, 0), 1, 1e-3}};
        const auto field = [&] { return *make_size_field(mesh, sizing, {}); };
        const auto refused = subdivide_to_sizes_inside(mesh, field(), 2000, context);
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.error().cause, Cause::kLimitExceeded);
        EXPECT_EQ(refused.error().field, "sizing");
        const std::string& message = refused.error().message;
        const std::size_t at = message.find("no size under ");
        ASSERT_NE(at, std::string::npos) << message;
        sizing.min_size = std::stod(message.substr(at + 14));
        EXPECT_TRUE(subdivide_to_sizes_inside(mesh, field(), 2000, context)) << message;
    }
    const auto whole = subdivide_to_sizes_inside(square(8), *make_size_field(square(8), {.max_size = 1.0}, {}), 10, context);
    EXPECT_EQ(whole.error().cause, Cause::kLimitExceeded) << "the mesh itself has more";
}

}  // namespace
}  // namespace vsplit::test
