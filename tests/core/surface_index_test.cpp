#include "spatial/surface_index.h"

#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "tests/core/meshes.h"
#include "tests/core/random.h"
#include "vsplit/io/read_mesh.h"

namespace vsplit {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Vec3 random_point(test::Random& random, double reach) {
    return {random.uniform(-reach, reach), random.uniform(-reach, reach), random.uniform(-reach, reach)};
}

/// Asks every shape.
template <class Shape>
typename ShapeIndex<Shape>::Hit closest_of_all(const ShapeIndex<Shape>& index, const Vec3& p) {
    typename ShapeIndex<Shape>::Hit best;
    for (std::uint32_t e = 0; e < index.size(); ++e) {
        const Footpoint foot = index.shape(e).closest(p);
        if (foot.squared_distance < best.squared_distance) best = {foot.squared_distance, foot.point, e};
    }
    return best;
}

template <class Shape>
void expect_same_as_all(const ShapeIndex<Shape>& index, const Vec3& p) {
    const auto hit = index.closest(p);
    const auto all = closest_of_all(index, p);
    EXPECT_EQ(hit.squared_distance, all.squared_distance);
    EXPECT_EQ(hit.element, all.element);
    EXPECT_EQ(hit.point, all.point);
}

/// Nearest point by ternary search along one side, nested; slow, and of another kind than what it checks.
double distance_by_search(const TriangleShape& t, const Vec3& p) {
    const Vec3& a = t.corners[0];
    const Vec3& b = t.corners[1];
    const Vec3& c = t.corners[2];
    const auto along = [&](double u) {
        const Vec3 from = a + (b - a) * u;
        const Vec3 to = a + (c - a) * u;
        const double whole = (to - from).squaredNorm();
        const double s = whole > 0 ? std::clamp((to - from).dot(p - from) / whole, 0.0, 1.0) : 0.0;
        return (p - from - (to - from) * s).norm();
    };
    double low = 0;
    double high = 1;
    for (int i = 0; i < 200; ++i) {
        const double third = (high - low) / 3;
        if (along(low + third) < along(high - third)) {
            high -= third;
        } else {
            low += third;
        }
    }
    return along((low + high) / 2);
}

TriangleMesh random_triangles(std::uint32_t count, double reach, std::uint64_t seed) {
    test::Random random(seed);
    TriangleMesh mesh;
    for (std::uint32_t f = 0; f < count; ++f) {
        const Vec3 at = random_point(random, reach);
        for (int i = 0; i < 3; ++i) mesh.positions.push_back(at + random_point(random, 1));
        mesh.faces.push_back({3 * f, 3 * f + 1, 3 * f + 2});
    }
    return mesh;
}

/// Cables askew in space: boxes along the axes of the coordinates hold nearly all of them.
TEST(SurfaceIndexTest, NearestOfNeedlesAlongOneDirectionTakesFewLooks) {
    test::Random random(7);
    const Vec3 along = Vec3(1, 2, -0.5).normalized() * 50;
    TriangleMesh mesh;
    for (std::uint32_t f = 0; f < 2000; ++f) {
        const Vec3 at = random_point(random, 10);
        for (const Vec3& corner : {at, Vec3(at + along), Vec3(at + random_point(random, 0.01))}) mesh.positions.push_back(corner);
        mesh.faces.push_back({3 * f, 3 * f + 1, 3 * f + 2});
    }
    const SurfaceIndex index = surface_index(mesh);
    std::uint64_t tests = 0;
    for (int i = 0; i < 100; ++i) {
        const Vec3 p = random_point(random, 20);
        expect_same_as_all(index, p);
        tests += index.closest(p).tests;
    }
    EXPECT_LT(tests, 100 * 200U) << "of 2000 each";
}

TEST(ShapesTest, TriangleDistanceIsThatOfASearch) {
    test::Random random(1);
    for (int round = 0; round < 2000; ++round) {
        const TriangleShape t{{random_point(random, 1), random_point(random, 1), random_point(random, 1)}};
        const Vec3 p = random_point(random, 2);
        EXPECT_NEAR(std::sqrt(t.closest(p).squared_distance), distance_by_search(t, p), 1e-7);
    }
}

TEST(ShapesTest, SliversOfAnyThinnessAreExact) {
    test::Random random(2);
    for (int round = 0; round < 4000; ++round) {
        const Vec3 a = random_point(random, 1);
        const Vec3 b = random_point(random, 1);
        const double height = std::pow(10.0, random.uniform(-18, 0));
        const TriangleShape t{{a, b, a + (b - a) * random.uniform(-0.2, 1.2) + random_point(random, 1) * height}};
        const Vec3 p = a + (b - a) * random.uniform(-0.5, 1.5) + random_point(random, 1) * std::pow(10.0, random.uniform(-6, 0));
        EXPECT_NEAR(std::sqrt(t.closest(p).squared_distance), distance_by_search(t, p), 3e-8) << "height " << height;
    }
}

TEST(ShapesTest, FacesWithoutAreaAreSegmentsAndPoints) {
    const TriangleShape segment{{Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(1, 0, 0)}};
    EXPECT_EQ(segment.closest(Vec3(1.5, 3, 4)).squared_distance, 25);
    EXPECT_EQ(segment.closest(Vec3(3, 0, 0)).point, Vec3(2, 0, 0));
    const TriangleShape point{{Vec3(1, 1, 1), Vec3(1, 1, 1), Vec3(1, 1, 1)}};
    EXPECT_EQ(point.closest(Vec3(1, 1, 3)).squared_distance, 4);
    for (const HalfSpace& side : point.sides()) EXPECT_EQ(side.excess(Vec3(9, 9, 9)), 0);
}

TEST(ShapesTest, SidesBoundThePrism) {
    const TriangleShape t{{Vec3(0, 0, 1), Vec3(1, 0, 1), Vec3(0, 1, 1)}};
    const auto inside = [&](const Vec3& p) {
        const auto sides = t.sides();
        return std::all_of(sides.begin(), sides.end(), [&](const HalfSpace& side) { return side.excess(p) <= 0; });
    };
    EXPECT_TRUE(inside(Vec3(0.3, 0.3, 7)));
    EXPECT_FALSE(inside(Vec3(-0.1, 0.3, 1)));
    EXPECT_FALSE(inside(Vec3(0.3, -0.1, 1)));
    EXPECT_FALSE(inside(Vec3(0.6, 0.6, 1)));
    EXPECT_NEAR(t.sides()[1].excess(Vec3(1, 1, 0)), std::sqrt(0.5), 1e-15);
}

TEST(SurfaceIndexTest, FindsWhatAskingEveryFaceFinds) {
    for (const double reach : {0.5, 3.0, 100.0}) {
        const SurfaceIndex index = surface_index(random_triangles(2000, reach, 3));
        test::Random random(4);
        for (int i = 0; i < 100; ++i) expect_same_as_all(index, random_point(random, 1.5 * reach));
        for (int i = 0; i < 10; ++i) expect_same_as_all(index, random_point(random, 1e6 * reach));
    }
}

TEST(SurfaceIndexTest, OfEquallyNearFacesTheSmallestIsGiven) {
    const TriangleMesh mesh = test::shuffled(test::icosphere(3), 5);
    const SurfaceIndex index = surface_index(mesh);
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        const auto holds = [&](const Triangle& t) { return std::find(t.begin(), t.end(), v) != t.end(); };
        const auto first = std::find_if(mesh.faces.begin(), mesh.faces.end(), holds);
        const SurfaceIndex::Hit hit = index.closest(mesh.positions[v]);
        EXPECT_EQ(hit.squared_distance, 0);
        EXPECT_EQ(hit.element, static_cast<std::uint32_t>(first - mesh.faces.begin()));
    }
}

TEST(SurfaceIndexTest, AnUpperBoundChangesNothingButWhatIsBeyond) {
    const TriangleMesh mesh = test::bumpy_sphere(3, 0.1, 6);
    const SurfaceIndex index = surface_index(mesh);
    test::Random random(7);
    for (int i = 0; i < 500; ++i) {
        const Vec3 p = random_point(random, 2);
        const SurfaceIndex::Hit free = index.closest(p);
        const SurfaceIndex::Hit exact = index.closest(p, free.squared_distance);
        EXPECT_EQ(exact.element, free.element) << "the bound counts as near enough";
        EXPECT_EQ(exact.squared_distance, free.squared_distance);
        EXPECT_EQ(index.closest(p, free.squared_distance * (1 - 1e-15)).element, SurfaceIndex::kNoElement);
    }
}

TEST(ShapesTest, APreparedTriangleSaysWhatTheTriangleSays) {
    test::Random random(21);
    for (int i = 0; i < 20000; ++i) {
        TriangleShape t{{random_point(random, 1), random_point(random, 1), random_point(random, 1)}};
        const double thinness = std::pow(10, random.uniform(-12, 0));
        if (i % 2 == 0) t.corners[2] = t.corners[0] + (t.corners[1] - t.corners[0]) * 0.3 + thinness * random_point(random, 1);
        const Vec3 p = random_point(random, 2);
        const PreparedTriangle prepared(t);
        const Footpoint foot = t.closest(p);
        EXPECT_EQ(prepared.closest(p).squared_distance, foot.squared_distance);
        EXPECT_EQ(prepared.squared_distance(p, kInfinity), foot.squared_distance);
        for (const double share : {0.25, 0.9999, 1.0001, 4.0}) {
            const double most = share * foot.squared_distance;
            const double found = prepared.squared_distance(p, most);
            if (foot.squared_distance < most) {
                EXPECT_EQ(found, foot.squared_distance);
            } else {
                EXPECT_GE(found, most);
            }
        }
    }
}

TEST(SurfaceIndexTest, AHintChangesNothing) {
    const TriangleMesh mesh = test::bumpy_sphere(3, 0.1, 6);
    const SurfaceIndex index = surface_index(mesh);
    test::Random random(9);
    std::uint32_t hint = SurfaceIndex::kNoElement;
    int near = 0;
    for (int i = 0; i < 5000; ++i) {
        const Vec3 p = random_point(random, 1.5);
        const double distance = random.uniform(0, 1);
        const bool within = index.within(p, distance);
        EXPECT_EQ(index.within(p, distance, hint), within);
        near += within ? 1 : 0;
        if (within) {
            EXPECT_LE(index.shape(hint).closest(p).squared_distance, distance * distance);
        }
        if (i % 7 == 0) hint = static_cast<std::uint32_t>(random.uniform(0, 2.0 * mesh.face_count()));
    }
    EXPECT_GT(near, 100);
    EXPECT_LT(near, 4900);
}

TEST(SurfaceIndexTest, WithinAgreesWithTheNearest) {
    const TriangleMesh mesh = test::bumpy_sphere(3, 0.1, 6);
    const SurfaceIndex index = surface_index(mesh);
    test::Random random(8);
    for (int i = 0; i < 500; ++i) {
        const Vec3 p = random_point(random, 2);
        const double distance = std::sqrt(index.closest(p).squared_distance);
        EXPECT_TRUE(index.within(p, distance * (1 + 1e-12)));
        EXPECT_FALSE(index.within(p, distance * (1 - 1e-12)));
    }
}

TEST(SurfaceIndexTest, ManyEqualShapesAndFarScalesAreNoTrouble) {
    TriangleMesh mesh;
    for (int i = 0; i < 5000; ++i) mesh.positions.insert(mesh.positions.end(), {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)});
    for (std::uint32_t f = 0; f < 5000; ++f) mesh.faces.push_back({3 * f, 3 * f + 1, 3 * f + 2});
    expect_same_as_all(surface_index(mesh), Vec3(1, 1, 1));

    // Each smaller than all before together: bins take one at a time.
    TriangleMesh spiral;
    double size = 1e15;
    for (std::uint32_t f = 0; f < 90; ++f, size /= 1.7) {
        spiral.positions.insert(spiral.positions.end(), {Vec3(size, 0, 0), Vec3(size, size / 9, 0), Vec3(size, 0, size / 9)});
        spiral.faces.push_back({3 * f, 3 * f + 1, 3 * f + 2});
    }
    const SurfaceIndex index = surface_index(spiral);
    double x = 1e-6;
    for (int i = 0; i < 48; ++i, x *= 3) expect_same_as_all(index, Vec3(x, x / 7, 0));

    for (const double scale : {1e-30, 1e-9, 1e9, 1e14}) {
        TriangleMesh scaled = test::icosphere(2);
        for (Vec3& p : scaled.positions) p = p * scale + Vec3(scale, 3 * scale, 0);
        const SurfaceIndex small = surface_index(scaled);
        test::Random random(8);
        for (int i = 0; i < 30; ++i) expect_same_as_all(small, random_point(random, 3 * scale));
        expect_same_as_all(small, Vec3(1e14, 2, 3));
    }
}

TEST(SurfaceIndexTest, AnEmptyOneFindsNothing) {
    const SurfaceIndex index = surface_index({});
    EXPECT_TRUE(index.empty());
    EXPECT_EQ(index.closest(Vec3(0, 0, 0)).element, SurfaceIndex::kNoElement);
    EXPECT_EQ(index.closest(Vec3(0, 0, 0)).squared_distance, kInfinity);
}

TEST(SurfaceIndexTest, ThreadsMayAskTogether) {
    const TriangleMesh mesh = test::bumpy_sphere(5, 0.1, 9);  // large enough to be built in parallel
    const SurfaceIndex index = surface_index(mesh);
    std::vector<SurfaceIndex::Hit> hits(mesh.positions.size());
    tbb::parallel_for(std::size_t{0}, hits.size(), [&](std::size_t v) { hits[v] = index.closest(mesh.positions[v] * 1.01); });
    for (std::size_t v = 0; v < hits.size(); ++v) {
        const SurfaceIndex::Hit again = index.closest(mesh.positions[v] * 1.01);
        EXPECT_EQ(hits[v].element, again.element);
        EXPECT_EQ(hits[v].squared_distance, again.squared_distance);
    }
    test::Random random(10);
    for (int i = 0; i < 50; ++i) expect_same_as_all(index, random_point(random, 1.5));
}

TEST(SurfaceIndexTest, FindsWhatAskingEveryFaceFindsOnRealParts) {
    std::vector<std::filesystem::path> files = test::own_closed_meshes();
    for (const auto& file : test::shared_closed_meshes()) files.push_back(file);
    for (const auto& file : files) {
        SCOPED_TRACE(test::test_name(file));
        const Expected<ReadResult> read = read_mesh_file(file.string(), {});
        ASSERT_TRUE(read);
        const SurfaceIndex index = surface_index(read->mesh);
        const BoundingBox box = bounding_box(read->mesh);
        test::Random random(11);
        for (int i = 0; i < 10; ++i) {
            expect_same_as_all(index, (box.min + box.max) / 2 + random_point(random, box.diagonal() / 2));
            expect_same_as_all(index, read->mesh.positions[random.below(read->mesh.vertex_count())]);
        }
    }
}

TEST(CreaseIndexTest, FindsWhatAskingEverySegmentFinds) {
    test::Random random(12);
    std::vector<Vec3> positions;
    std::vector<EdgeEnds> edges;
    for (std::uint32_t i = 0; i < 1000; ++i) {
        positions.push_back(random_point(random, 5));
        positions.push_back(i % 10 == 0 ? positions.back() : Vec3(positions.back() + random_point(random, 1)));
        edges.push_back({2 * i, 2 * i + 1});
    }
    const CreaseIndex index = crease_index(positions, edges);
    for (int i = 0; i < 300; ++i) expect_same_as_all(index, random_point(random, 7));
    EXPECT_EQ(index.shape(7).corners[1], positions[15]);
}

/// The hint is what a shape itself says: however little that is, the shape is found with it.
TEST(SurfaceIndexTest, AShapesOwnDistanceIsAHintThatFindsIt) {
    test::Random random(31);
    TriangleMesh mesh;
    for (std::uint32_t f = 0; f < 500; ++f) {
        const Vec3 place = Vec3(-20000, 9000, 5000) + random_point(random, 500);
        for (int corner = 0; corner < 3; ++corner) mesh.positions.push_back(place + random_point(random, 1));
        mesh.faces.push_back({3 * f, 3 * f + 1, 3 * f + 2});
    }
    const SurfaceIndex index = surface_index(mesh);
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        for (const std::uint32_t v : mesh.faces[f]) {
            for (int step = 0; step < 20; ++step) {  // within a few roundings of a corner
                const Vec3 p = mesh.positions[v] + random_point(random, 1e-11);
                EXPECT_NE(index.closest(p, index.shape(f).closest(p).squared_distance).element, SurfaceIndex::kNoElement);
            }
        }
    }
}

}  // namespace
}  // namespace vsplit
