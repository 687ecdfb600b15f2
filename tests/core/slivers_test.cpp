#include "vsplit/quality/slivers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "quality/crease_gap.h"
#include "quality/sliver_bounds.h"
#include "tests/core/meshes.h"
#include "tests/core/random.h"
#include "vsplit/features/creases.h"
#include "vsplit/method/improve.h"
#include "vsplit/mrr/progressive_mesh.h"
#include "vsplit/quality/mesh_quality.h"
#include "vsplit/quality/stretch.h"

namespace vsplit::test {
namespace {

std::vector<SharpEdge> creases_of(const TriangleMesh& mesh) { return find_creases(mesh, face_normals(mesh), {}); }

std::vector<Slivers> explained(const TriangleMesh& mesh, double max_deviation = 0) {
    return explain_slivers(mesh, creases_of(mesh), {.edge = 0, .max_deviation = max_deviation});
}

std::uint32_t count_of(const std::vector<Slivers>& all, SliverCause cause) {
    const auto at = std::find_if(all.begin(), all.end(), [&](const Slivers& s) { return s.cause == cause; });
    return at == all.end() ? 0 : at->count;
}

/// A flat open strip of `rows` rows of rectangles, each cut in two.
TriangleMesh strip(std::uint32_t columns, std::uint32_t rows, double step, double width) {
    TriangleMesh mesh;
    for (std::uint32_t i = 0; i <= columns; ++i) {
        for (std::uint32_t j = 0; j <= rows; ++j) mesh.positions.emplace_back(i * step, j * width / rows, 0);
    }
    const auto at = [&](std::uint32_t i, std::uint32_t j) { return i * (rows + 1) + j; };
    for (std::uint32_t i = 0; i < columns; ++i) {
        for (std::uint32_t j = 0; j < rows; ++j) {
            mesh.faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            mesh.faces.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    }
    return mesh;
}

/// Rolled around the y axis, so that x is the length of an arc of radius 1.
TriangleMesh rolled(TriangleMesh mesh) {
    for (Vec3& p : mesh.positions) p = Vec3(std::sin(p.x()), p.y(), std::cos(p.x()));
    return mesh;
}

/// A flat sector of `faces` faces from (0, 0) outward, `angle` degrees in all.
TriangleMesh sector(int faces, double angle) {
    TriangleMesh mesh;
    mesh.positions.emplace_back(0, 0, 0);
    for (int i = 0; i <= faces; ++i) {
        const double at = angle * std::numbers::pi / 180 * i / faces;
        mesh.positions.emplace_back(std::cos(at), std::sin(at), 0);
    }
    for (std::uint32_t i = 1; i < mesh.positions.size() - 1; ++i) mesh.faces.push_back({0, i, i + 1});
    return mesh;
}

TEST(SliversTest, BoundsAreThoseOfTheBestTriangle) {
    Random random(3);
    const auto stretch_at = [](double x, double y) { return stretch(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(x, y, 0)); };
    for (const double s : {0.05, 0.2, 0.6, 0.9}) {
        const double height = height_for_stretch(s), edge = short_edge_for_stretch(s), angle = angle_for_stretch(s);
        EXPECT_NEAR(stretch_at(0.5, height), s, 1e-9);
        EXPECT_NEAR(stretch_at(std::cos(angle), std::sin(angle)), s, 1e-9);
        EXPECT_NEAR((Vec3(std::cos(angle), std::sin(angle), 0) - Vec3(1, 0, 0)).norm(), edge, 1e-9);
        for (int n = 0; n < 20000; ++n) {  // an apex that leaves (0, 1) the longest edge
            const double x = random.uniform(0, 1), y = random.uniform(1e-6, 1);
            const double left = std::hypot(x, y), right = std::hypot(1 - x, y);
            if (std::max(left, right) > 1) continue;
            if (y < height || std::min(left, right) < edge || std::atan2(y, std::max(x, 1 - x)) < angle) {
                EXPECT_LT(stretch_at(x, y), s + 1e-12) << x << ' ' << y;
            }
        }
    }
}

TEST(SliversTest, FacesBetweenCloseCreasesAreForced) {
    const std::vector<TriangleMesh> strips{strip(8, 1, 0.25, 0.02), strip(8, 3, 0.25, 0.02), rolled(strip(8, 2, 0.25, 0.02)),
                                           shuffled(strip(40, 1, 0.25, 0.02), 5)};
    for (const TriangleMesh& mesh : strips) {
        const std::vector<Slivers> found = explain_slivers(mesh, creases_of(mesh), {.edge = 0.25});
        ASSERT_EQ(found.size(), 1U) << mesh.face_count();
        EXPECT_EQ(found[0].cause, SliverCause::kNarrowStrip);
        EXPECT_EQ(found[0].count, mesh.face_count());
        EXPECT_NEAR(found[0].least, 0.02, 1e-4);  // across the face's longest edge, which may be a diagonal
        EXPECT_NEAR(found[0].most, 0.02, 1e-4);
        EXPECT_EQ(found[0].elements.size(), std::min<std::size_t>(Slivers::kExamples, mesh.face_count()));
    }
    EXPECT_EQ(explained(strips[0])[0].message, "16 faces lie between creases 0.0200639 apart");
}

TEST(SliversTest, AGapIsTheWidthOfTheStripWhateverItsFaces) {
    Random random(7);
    for (int n = 0; n < 40; ++n) {
        const double width = random.uniform(0.01, 0.3), step = random.uniform(0.1, 1);
        const TriangleMesh flat = strip(60, 1 + random.below(5), step, width);
        TriangleMesh mesh = flat;
        for (Vec3& p : mesh.positions) {
            const bool rim = p.y() < 1e-9 || p.y() > width - 1e-9;
            p.x() += random.uniform(-0.2, 0.2) * step + 3 * p.y();
            if (!rim) p.y() += random.uniform(-0.05, 0.05) * width;
        }
        // Rolled up it has facets, and the straightest way over them is a little longer.
        const double longest = n % 2 == 1 ? 1.02 * width : width + 1e-9;
        if (n % 2 == 1) {
            for (Vec3& p : mesh.positions) p.x() *= 0.2;
            mesh = rolled(mesh);
        }
        CreaseMarks marks(mesh);
        for (HalfEdge h = 0; h < marks.half_edge_count(); ++h) {
            // Across the middle of the strip only: the walk must not run out of an end.
            const double middle = (flat.positions[origin(flat, h)].x() + flat.positions[origin(flat, next(h))].x()) / 2;
            const Vec3 way = mesh.positions[origin(mesh, next(h))] - mesh.positions[origin(mesh, h)];
            if (std::abs(way.y()) > 1e-12 || std::abs(middle - 30 * step) > 2 * step) continue;
            const auto gap = crease_gap(mesh, marks, h, 2 * width);
            ASSERT_TRUE(gap.has_value()) << n << ' ' << h;
            EXPECT_GE(*gap, width - 1e-9) << n;
            EXPECT_LE(*gap, longest) << n;
            EXPECT_FALSE(crease_gap(mesh, marks, h, 0.999 * width).has_value());
        }
    }
}

TEST(SliversTest, NeedlesAcrossAWideStripAreNotForced) {
    const TriangleMesh mesh = strip(30, 1, 0.05, 1);
    const std::vector<Slivers> found = explained(mesh);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].cause, SliverCause::kUnexplained);
    EXPECT_EQ(found[0].count, mesh.face_count());
    const Quality quality = measure_quality(mesh);
    EXPECT_EQ(found[0].least, quality.stretch_min);
}

TEST(SliversTest, ASliverLongerThanTheEdgesWantedIsNotForcedByItsLength) {
    const TriangleMesh mesh = strip(8, 1, 0.25, 0.02);
    const auto cause = [&](double edge) { return explain_slivers(mesh, creases_of(mesh), {.edge = edge})[0].cause; };
    EXPECT_EQ(cause(0.2), SliverCause::kNarrowStrip);
    EXPECT_EQ(cause(0.1), SliverCause::kUnexplained) << "edges of 0.1 would have filled the strip well enough";
}

TEST(SliversTest, CreasesThatMeetAtASmallAngleForceAFace) {
    for (const int faces : {1, 2, 4}) {
        const std::vector<Slivers> found = explained(sector(faces, 5));
        EXPECT_EQ(count_of(found, SliverCause::kSharpCorner), faces);
        ASSERT_FALSE(found.empty());
        EXPECT_NEAR(found[0].least, 5, 1e-9);
    }
    EXPECT_EQ(explained(sector(1, 5))[0].message, "1 face lies where two creases meet at 5 degrees");
    const std::vector<Slivers> wide = explained(sector(6, 30));
    EXPECT_EQ(count_of(wide, SliverCause::kSharpCorner), 0U) << "one face would fill 30 degrees well";
    EXPECT_EQ(count_of(wide, SliverCause::kUnexplained), 6U);
    EXPECT_TRUE(explained(sector(1, 8)).empty()) << "no sliver";
}

/// Two vertices 0.02 apart amid faces of size 1, with creases that fork off on either side.
TriangleMesh close_pair() {
    TriangleMesh mesh;
    mesh.positions = {Vec3(0, 0, 0),   Vec3(0.02, 0, 0), Vec3(0.01, 1, 0),  Vec3(0.01, -1, 0),
                      Vec3(-1, .3, 0), Vec3(-1, -.3, 0), Vec3(1.02, .3, 0), Vec3(1.02, -.3, 0)};
    mesh.faces = {{0, 1, 2}, {1, 0, 3}, {0, 2, 4}, {0, 4, 5}, {0, 5, 3}, {1, 6, 2}, {1, 7, 6}, {1, 3, 7}};
    return mesh;
}

TEST(SliversTest, CloseCornersOfCreasesForceNeedles) {
    const TriangleMesh mesh = close_pair();
    const std::vector<SharpEdge> forks{{0, 1, 1}, {0, 4, 1}, {0, 5, 1}, {1, 6, 1}, {1, 7, 1}};
    const std::vector<Slivers> found = explain_slivers(mesh, forks, {});
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].cause, SliverCause::kCloseCorners);
    EXPECT_EQ(found[0].count, 2U);
    EXPECT_NEAR(found[0].least, 0.02, 1e-12);
    EXPECT_EQ(found[0].elements, (std::vector<std::uint32_t>{0, 1}));

    const std::vector<SharpEdge> apart{{0, 4, 1}, {1, 6, 1}};
    EXPECT_EQ(explain_slivers(mesh, apart, {})[0].cause, SliverCause::kNarrowStrip) << "two creases that end beside each other";
    const std::vector<SharpEdge> straight{{0, 1, 1}, {0, 4, 1}};
    EXPECT_EQ(explain_slivers(mesh, straight, {})[0].cause, SliverCause::kUnexplained) << "one crease, and its end";
    EXPECT_EQ(explain_slivers(mesh, {}, {})[0].cause, SliverCause::kUnexplained);
}

/// A sphere with a vertex more on it, close to one end of an edge.
TriangleMesh sphere_with_needles(double nearness) {
    TriangleMesh mesh = icosphere(2);
    const Triangle t = mesh.faces[0];
    const std::uint32_t a = t[0], b = t[1], c = t[2];
    const auto other = std::find_if(mesh.faces.begin() + 1, mesh.faces.end(), [&](const Triangle& f) {
        return std::count(f.begin(), f.end(), a) + std::count(f.begin(), f.end(), b) == 2;
    });
    std::uint32_t d = 0;
    for (const std::uint32_t v : *other) d = v != a && v != b ? v : d;
    const std::uint32_t m = mesh.vertex_count();
    mesh.positions.push_back((mesh.positions[a] + nearness * (mesh.positions[b] - mesh.positions[a])).normalized());
    *other = {b, m, d};
    mesh.faces[0] = {m, b, c};
    mesh.faces.push_back({a, m, c});
    mesh.faces.push_back({m, a, d});
    return mesh;
}

TEST(SliversTest, ALongTubeForcesFacesAlongIt) {
    // Sides so many that none is a crease, each as long as the tube: forced where the tube is thin for that, and only there.
    for (const double length : {5.0, 20.0, 400.0}) {
        TriangleMesh tube = open_cylinder(24, 1);
        for (Vec3& p : tube.positions) p.z() *= length / 2;
        const double girth = 48 * std::sin(std::numbers::pi / 24);
        const std::vector<Slivers> found = explain_slivers(tube, creases_of(tube), {});
        const std::uint32_t thin = count_of(found, SliverCause::kNarrowPart);
        if (girth >= 2 * height_for_stretch(kStretchFloor) * length) {
            EXPECT_EQ(thin, 0U);
            continue;
        }
        EXPECT_GT(thin, 0U);
        for (const Slivers& s : found) {
            if (s.cause != SliverCause::kNarrowPart) continue;
            EXPECT_NEAR(s.least, girth, 1e-4);  // the longest edge is a diagonal
            EXPECT_NEAR(s.most, girth, 1e-4);
        }
    }
}

TEST(SliversTest, ABoundOnTheDeviationThatEveryMendBreaksIsTheCause) {
    const TriangleMesh mesh = sphere_with_needles(0.05);
    const auto found = [&](double max_deviation) {
        return explain_slivers(mesh, {}, {.edge = 0, .max_deviation = max_deviation});
    };
    ASSERT_EQ(found(0).size(), 1U);
    EXPECT_EQ(found(0)[0].count, 2U);
    EXPECT_EQ(found(0)[0].cause, SliverCause::kUnexplained) << "there is no bound";
    EXPECT_EQ(found(0.1)[0].cause, SliverCause::kUnexplained) << "the bound allows to mend them";
    const std::vector<Slivers> held = found(1e-4);
    ASSERT_EQ(held.size(), 1U);
    EXPECT_EQ(held[0].cause, SliverCause::kDeviation);
    EXPECT_EQ(held[0].count, 2U);
    // The vertex lies on the sphere, the faces it would go back to within the sagitta of an edge below.
    EXPECT_GT(held[0].least, 1e-4);
    EXPECT_LT(held[0].most, 0.02);
}

TEST(SliversTest, EveryFaceUnderTheFloorIsCountedOnce) {
    std::vector<TriangleMesh> meshes{sliver_cylinder(40, 10), joined(sliver_cylinder(30, 4), cube(), Vec3(9, 0, 0)),
                                     close_pair()};
    for (const NamedMesh& named : small_meshes()) meshes.push_back(shuffled(named.mesh, 2));
    int with_slivers = 0;
    for (const TriangleMesh& mesh : meshes) {
        const std::vector<Slivers> found = explained(mesh, 1e-3);
        std::uint32_t count = 0;
        std::set<std::uint32_t> listed;
        for (const Slivers& s : found) {
            count += s.count;
            EXPECT_LE(s.least, s.most);
            EXPECT_NE(s.message.find(std::to_string(s.count)), std::string::npos) << s.message;
            for (const std::uint32_t f : s.elements) {
                EXPECT_TRUE(listed.insert(f).second) << f;
                const Triangle& t = mesh.faces.at(f);
                EXPECT_LT(stretch(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]), kStretchFloor);
            }
        }
        EXPECT_EQ(count, measure_quality(mesh).faces_below_02);
        with_slivers += count > 0 ? 1 : 0;
    }
    EXPECT_GE(with_slivers, 3);
    EXPECT_TRUE(explained(icosphere(3)).empty());
}

TEST(SliversTest, FacesWithoutAreaDoNoHarm) {
    TriangleMesh mesh = cube();
    mesh.positions[mesh.faces[0][0]] = mesh.positions[mesh.faces[0][1]];
    const std::vector<Slivers> found = explained(mesh, 1e-3);
    ASSERT_FALSE(found.empty());
    for (const Slivers& s : found) EXPECT_TRUE(std::isfinite(s.least) && std::isfinite(s.most)) << s.message;
}

/// A plate with a step of 0.004 in it, as a method meets it.
TriangleMesh plate_with_step() {
    // The outline of the side, counter-clockwise, extruded along y.
    const std::vector<std::array<double, 2>> outline{{0, 0}, {2, 0}, {2, 0.504}, {1, 0.504}, {1, 0.5}, {0, 0.5}};
    TriangleMesh mesh;
    for (const double y : {0.0, 1.0}) {
        for (const auto& p : outline) mesh.positions.emplace_back(p[0], y, p[1]);
    }
    for (std::uint32_t i = 0; i < 6; ++i) {
        const std::uint32_t j = (i + 1) % 6;
        mesh.faces.push_back({i, j + 6, j});
        mesh.faces.push_back({i, i + 6, j + 6});
    }
    const std::vector<Triangle> side{{0, 1, 4}, {0, 4, 5}, {1, 2, 4}, {2, 3, 4}};
    for (const Triangle& t : side) {
        mesh.faces.push_back(t);
        mesh.faces.push_back({t[2] + 6, t[1] + 6, t[0] + 6});
    }
    return mesh;
}

TEST(SliversTest, AMethodTellsWhatForcedThoseItLeaves) {
    const TriangleMesh source = plate_with_step();
    for (const Mode mode : {Mode::kExtended, Mode::kStrict}) {
        ImproveOptions options{.subdivision_size = 0.1, .tolerance = 1e-5, .faces = 3000, .mode = mode};
        const Expected<MethodResult> result = improve(source, options, {}, ExecutionContext());
        ASSERT_TRUE(result) << result.error().message;
        ASSERT_GT(result->quality.faces_below_02, 0U) << "the step is too low for anything else";
        std::uint32_t count = 0;
        for (const Slivers& s : result->slivers) count += s.count;
        EXPECT_EQ(count, result->quality.faces_below_02);
        ASSERT_FALSE(result->slivers.empty());
        EXPECT_EQ(result->slivers[0].cause, SliverCause::kNarrowStrip) << result->slivers[0].message;
        EXPECT_NEAR(result->slivers[0].least, 0.004, 4e-4);
    }
    const Expected<MethodResult> fair = improve(cube(), {}, {}, ExecutionContext());
    ASSERT_TRUE(fair);
    EXPECT_TRUE(fair->slivers.empty());
}

}  // namespace
}  // namespace vsplit::test
