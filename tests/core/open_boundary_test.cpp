#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <ostream>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "mesh/boundary_loops.h"
#include "spatial/surface_index.h"
#include "tests/core/meshes.h"
#include "tests/core/random.h"
#include "tests/core/sampled_deviation.h"
#include "vsplit/io/read_mesh.h"
#include "vsplit/mesh/inspect.h"
#include "vsplit/mesh/weld.h"
#include "vsplit/method/control.h"
#include "vsplit/method/improve.h"
#include "vsplit/mrr/mrr_file.h"
#include "vsplit/mrr/progressive_mesh.h"

/// Meshes with open boundaries through both methods in both modes, as a user meets them.
namespace vsplit::test {
namespace {

/// A mesh, and what it is cut to and brought down to in a second or so.
struct Sheet {
    std::string name;
    TriangleMesh mesh;
    double size = 0;             // of improve
    std::uint32_t subdivisions;  // of control
    std::uint32_t faces = 0;
};

std::vector<Sheet> sheets() {
    return {
        {"square", square(4), 0.2, 2, 150},
        {"holes", holed_square(8, 3), 0.4, 1, 300},
        {"cylinder", open_cylinder(48, 6), 0.12, 1, 500},
        {"hemisphere", hemisphere(40, 10), 0.1, 1, 700},
        {"pierced_torus", punctured(torus(36, 16), {0, 100, 250, 400}), 0.12, 1, 1200},
        {"closed_and_open", joined(joined(icosphere(2), holed_square(6, 1), Vec3(3, 0, 0)), square(1), Vec3(0, 0, 5)), 0.3, 1,
         500},
    };
}

struct Case {
    Sheet sheet;
    bool improving = true;
    Mode mode = Mode::kExtended;
};

std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.sheet.name; }

std::vector<Case> cases(const std::vector<Mode>& modes) {
    std::vector<Case> all;
    for (const Sheet& sheet : sheets()) {
        for (const bool improving : {true, false}) {
            for (const Mode mode : modes) all.push_back({sheet, improving, mode});
        }
    }
    return all;
}

std::string case_name(const testing::TestParamInfo<Case>& info) {
    return info.param.sheet.name + (info.param.improving ? "_improve" : "_control") +
           (info.param.mode == Mode::kStrict ? "_strict" : "_extended");
}

struct Asked {
    bool frozen = false;
    unsigned threads = 2;
    std::optional<double> max_deviation{};
};

MethodResult run(const Case& c, const Asked& asked = {}) {
    const ExecutionContext context(nullptr, asked.threads);
    Expected<MethodResult> result = [&] {
        if (c.improving) {
            ImproveOptions options{.subdivision_size = c.sheet.size, .faces = c.sheet.faces, .mode = c.mode};
            options.freeze_boundary = asked.frozen;
            options.max_deviation = asked.max_deviation;
            return improve(c.sheet.mesh, options, {}, context);
        }
        ControlOptions options{.subdivisions = c.sheet.subdivisions, .faces = c.sheet.faces, .mode = c.mode};
        options.freeze_boundary = asked.frozen;
        options.max_deviation = asked.max_deviation;
        return control(c.sheet.mesh, options, {}, context);
    }();
    EXPECT_TRUE(result) << result.error().message;
    return result ? std::move(*result) : MethodResult{};
}

double default_tolerance(const TriangleMesh& mesh) { return kDefaultToleranceShare * bounding_box(mesh).diagonal(); }

std::vector<EdgeEnds> boundary(const TriangleMesh& mesh) {
    std::vector<EdgeEnds> edges;
    for (const auto& loop : boundary_loops(mesh)) {
        for (const HalfEdge h : loop) edges.push_back({origin(mesh, h), origin(mesh, next(h))});
    }
    return edges;
}

/// The largest distance of points on the boundary of one mesh to that of another.
double boundary_distance(const TriangleMesh& from, const TriangleMesh& to) {
    const std::vector<EdgeEnds> ends = boundary(to);
    const CreaseIndex index = crease_index(to.positions, ends);
    double largest = 0;
    for (const EdgeEnds& e : boundary(from)) {
        for (int n = 0; n <= 8; ++n) {
            const Vec3 p = from.positions[e[0]] + n / 8.0 * (from.positions[e[1]] - from.positions[e[0]]);
            largest = std::max(largest, index.closest(p).squared_distance);
        }
    }
    return std::sqrt(largest);
}

/// What must not change. Counted here from the faces alone.
struct Topology {
    std::size_t loops = 0;
    std::uint32_t components = 0;
    std::int64_t euler = 0;

    friend bool operator==(const Topology&, const Topology&) = default;
    friend std::ostream& operator<<(std::ostream& out, const Topology& t) {
        return out << t.loops << " loops, " << t.components << " components, Euler characteristic " << t.euler;
    }
};

Topology topology(const TriangleMesh& mesh) {
    std::set<std::uint32_t> vertices;
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (const Triangle& f : mesh.faces) {
        for (int c = 0; c < 3; ++c) {
            vertices.insert(f[c]);
            edges.insert(std::minmax(f[c], f[(c + 1) % 3]));
        }
    }
    return {boundary_loops(mesh).size(), inspect(mesh).components,
            static_cast<std::int64_t>(vertices.size()) - static_cast<std::int64_t>(edges.size()) + mesh.face_count()};
}

std::vector<std::size_t> some_levels(const MultiresMesh& mrr) {
    std::vector<std::size_t> levels{0, mrr.levels()};
    for (int n = 1; n < 6; ++n) levels.push_back(n * mrr.levels() / 6);
    return levels;
}

using Point = std::array<double, 3>;
Point point(const Vec3& p) { return {p.x(), p.y(), p.z()}; }

/// Boundary edges by where they lie, bit for bit.
std::set<std::pair<Point, Point>> placed_boundary(const TriangleMesh& mesh) {
    std::set<std::pair<Point, Point>> edges;
    for (const EdgeEnds& e : boundary(mesh)) edges.insert({point(mesh.positions[e[0]]), point(mesh.positions[e[1]])});
    return edges;
}

class OpenBoundary : public testing::TestWithParam<Case> {
protected:
    const TriangleMesh& source_ = GetParam().sheet.mesh;
    const bool extended_ = GetParam().mode == Mode::kExtended;
};

TEST_P(OpenBoundary, LoopsComponentsAndEulerCharacteristicAreKeptAtEveryLevel) {
    for (const bool frozen : {false, true}) {
        const MethodResult result = run(GetParam(), {.frozen = frozen});
        ASSERT_GT(result.mrr.levels(), frozen ? 10U : 50U);
        EXPECT_EQ(result.mrr.ghosts, boundary_loops(source_).size());
        const Topology before = topology(source_);
        for (const std::size_t level : some_levels(result.mrr)) {
            const TriangleMesh mesh = mesh_at(result.mrr, level);
            EXPECT_TRUE(require_manifold(inspect(mesh))) << level;
            EXPECT_EQ(topology(mesh), before) << level;
            EXPECT_EQ(mesh.face_count(), result.mrr.faces_at(level)) << level;
        }
        EXPECT_EQ(result.mrr.faces_max(), result.faces_subdivided);
        if (frozen) continue;
        EXPECT_LE(result.faces, GetParam().sheet.faces);
        EXPECT_GE(result.faces, GetParam().sheet.faces - 2);
    }
}

TEST_P(OpenBoundary, TheBoundaryStaysOnTheSourcesBothWays) {
    const MethodResult result = run(GetParam());
    // Extended: what max_deviation is by default. Strict has no bound but the quadrics, whose lines weigh 10.
    const double limit = 2 * default_tolerance(source_);
    for (const std::size_t level : some_levels(result.mrr)) {
        const TriangleMesh mesh = mesh_at(result.mrr, level);
        EXPECT_LE(boundary_distance(mesh, source_), limit) << level;
        EXPECT_LE(boundary_distance(source_, mesh), limit) << level;
    }
}

TEST_P(OpenBoundary, AFrozenBoundaryIsTheSourcesBitForBitAtEveryLevel) {
    const MethodResult result = run(GetParam(), {.frozen = true});
    const auto wanted = placed_boundary(source_);
    for (const std::size_t level : some_levels(result.mrr))
        EXPECT_EQ(placed_boundary(mesh_at(result.mrr, level)), wanted) << level;
    EXPECT_LT(result.mrr.faces_min(), result.mrr.faces_max());
    EXPECT_NE(placed_boundary(mesh_at(run(GetParam()).mrr, 0)), wanted) << "else nothing was held";
}

TEST_P(OpenBoundary, RefiningAndCoarseningGoBackExactly) {
    const MethodResult result = run(GetParam());
    const MultiresMesh& mrr = result.mrr;
    EXPECT_EQ(extended_, mrr.records.flips().size() > 0 && mrr.records.moves().size() > 0) << "all three kinds";
    auto mesh = ProgressiveMesh::from_base(mrr.base, mrr.ghosts);
    ASSERT_TRUE(mesh) << mesh.error().message;
    Random random(7);
    for (int n = 0; n < 6; ++n) {
        const std::size_t level = random.below(static_cast<std::uint32_t>(mrr.levels()) + 1);
        const Status refined = mesh->refine(mrr.records.slice(0, mrr.record_of_level(level)));
        ASSERT_TRUE(refined) << refined.error().message;
        const std::size_t part = random.below(static_cast<std::uint32_t>(level) + 1);
        mesh->coarsen(part);
        EXPECT_EQ(mesh->visible(), mesh_at(mrr, level - part));
        mesh->coarsen(level - part);
        ASSERT_EQ(mesh->mesh(), mrr.base);
    }
}

TEST_P(OpenBoundary, SameBytesForOneAndTwoThreads) {
    for (const bool frozen : {false, true}) {
        const std::string one = encode_mrr({run(GetParam(), {.frozen = frozen, .threads = 1}).mrr, 100, ""});
        EXPECT_TRUE(one == encode_mrr({run(GetParam(), {.frozen = frozen, .threads = 2}).mrr, 100, ""})) << frozen;
        const auto back = decode_mrr(std::as_bytes(std::span(one)));
        EXPECT_TRUE(back) << back.error().message;
    }
}

INSTANTIATE_TEST_SUITE_P(All, OpenBoundary, testing::ValuesIn(cases({Mode::kStrict, Mode::kExtended})), case_name);

class OpenBoundaryWithin : public OpenBoundary {};

TEST_P(OpenBoundaryWithin, AMaximalDeviationHoldsForSurfaceAndBoundary) {
    const double limit = 5e-4 * bounding_box(source_).diagonal();
    const MethodResult result = run(GetParam(), {.max_deviation = limit});
    ASSERT_TRUE(result.quality.deviation_max.has_value());
    EXPECT_LE(*result.quality.deviation_max, limit);
    const TriangleMesh mesh = mesh_at(result.mrr, result.mrr.level_for(result.faces));
    EXPECT_LE(sampled_deviation(mesh, source_, 4), limit * (1 + 1e-9));
    EXPECT_LE(sampled_deviation(source_, mesh, 4), limit * (1 + 1e-9));
    EXPECT_LE(boundary_distance(mesh, source_), limit);
    EXPECT_LE(boundary_distance(source_, mesh), limit);
}

INSTANTIATE_TEST_SUITE_P(All, OpenBoundaryWithin, testing::ValuesIn(cases({Mode::kExtended})), case_name);

/// Where a boundary turns by more than 40 degrees.
std::set<Point> corners(const TriangleMesh& mesh) {
    std::set<Point> all;
    for (const auto& loop : boundary_loops(mesh)) {
        for (std::size_t n = 0; n < loop.size(); ++n) {
            const Vec3& at = mesh.positions[origin(mesh, loop[n])];
            const Vec3 in = at - mesh.positions[origin(mesh, loop[(n + loop.size() - 1) % loop.size()])];
            const Vec3 out = mesh.positions[origin(mesh, next(loop[n]))] - at;
            if (in.dot(out) < std::cos(40 * std::acos(-1.0) / 180) * in.norm() * out.norm()) all.insert(point(at));
        }
    }
    return all;
}

TEST(OpenBoundaryTest, APlanePatchKeepsItsAreaAndItsCornersExactly) {
    for (const TriangleMesh& source : {square(4), holed_square(8, 3), joined(square(3), holed_square(4, 1), Vec3(9, 0, 0))}) {
        const Sheet sheet{"", source, 0.3, 2, 4};
        const std::set<Point> wanted = corners(source);
        EXPECT_EQ(wanted.size() % 4, 0U);
        for (const bool improving : {true, false}) {
            for (const Mode mode : {Mode::kStrict, Mode::kExtended}) {
                const MethodResult result = run({sheet, improving, mode});
                for (const std::size_t level : some_levels(result.mrr)) {
                    const TriangleMesh mesh = mesh_at(result.mrr, level);
                    EXPECT_EQ(corners(mesh), wanted) << level;
                    EXPECT_NEAR(surface_area(mesh), surface_area(source), 1e-9 * surface_area(source)) << level;
                }
            }
        }
    }
}

TEST(OpenBoundaryTest, BoundaryVerticesDoMoveAlongTheBoundary) {
    // Uneven spacing, which an even one is made of only by moving along the sides.
    TriangleMesh source = square(10);
    Random random(3);
    for (Vec3& p : source.positions) {
        for (int axis = 0; axis < 2; ++axis) {
            if (p[axis] != 0 && p[axis] != 10) p[axis] += random.uniform(-0.3, 0.3);
        }
    }
    const Sheet sheet{"", source, 20, 0, 200};
    const MethodResult result = run({sheet, true, Mode::kExtended});
    const TriangleMesh dense = mesh_at(result.mrr, result.mrr.levels());
    const std::set<std::pair<Point, Point>> before = placed_boundary(source);
    std::size_t same = 0;
    for (const auto& edge : placed_boundary(dense)) same += before.count(edge);
    EXPECT_LT(same, before.size() / 2);
    EXPECT_NEAR(surface_area(dense), 100, 1e-9);
}

TEST(OpenBoundaryTest, SmallestMeshesComeBack) {
    TriangleMesh one;
    one.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    one.faces = {{0, 1, 2}};
    const TriangleMesh two = square(1);
    const TriangleMesh pair = joined(one, tetrahedron(), Vec3(5, 0, 0));
    for (const TriangleMesh& source : {one, two, pair}) {
        for (const Mode mode : {Mode::kStrict, Mode::kExtended}) {
            for (const bool frozen : {false, true}) {
                for (const bool improving : {true, false}) {
                    const Sheet sheet{"", source, 0.1, 3, 4};
                    const MethodResult result = run({sheet, improving, mode}, {.frozen = frozen});
                    EXPECT_EQ(topology(mesh_at(result.mrr, 0)), topology(source));
                    EXPECT_LE(result.mrr.faces_min(), 12U);
                    if (!frozen) continue;
                    EXPECT_EQ(placed_boundary(mesh_at(result.mrr, 0)), placed_boundary(source));
                }
            }
        }
    }
}

TEST(OpenBoundaryTest, FreezingMeansNothingToAClosedMesh) {
    const Sheet sheet{"", plate_with_holes(1), 0.4, 2, 300};
    for (const bool improving : {true, false}) {
        const Case c{sheet, improving, Mode::kExtended};
        EXPECT_EQ(run(c, {.frozen = true}).mrr, run(c).mrr);
    }
}

TEST(OpenBoundaryTest, ARoughBoundaryIsNotFrozenByItsTeeth) {
    TriangleMesh source = square(40);
    Random random(1);
    for (Vec3& p : source.positions) {
        if (p.y() == 0 && p.x() > 0 && p.x() < 40) p.y() = static_cast<int>(p.x()) % 2 == 0 ? 0 : -0.5;  // turns of 53 degrees
    }
    const Sheet sheet{"", source, 100, 0, 400};
    const ExecutionContext context;
    ImproveOptions options{.subdivision_size = 100, .tolerance = 0.5, .faces = 300};
    const auto loose = improve(source, options, {}, context);
    options.tolerance = 0.05;
    const auto tight = improve(source, options, {}, context);
    ASSERT_TRUE(loose && tight);
    const auto teeth = [](const MethodResult& result) {
        const TriangleMesh mesh = mesh_at(result.mrr, result.mrr.level_for(300));
        return std::count_if(mesh.positions.begin(), mesh.positions.end(), [](const Vec3& p) { return p.y() < -0.45; });
    };
    EXPECT_EQ(teeth(*tight), 20);
    EXPECT_LT(teeth(*loose), 5);
}

TEST(OpenBoundaryTest, RefusesABoundaryThatTouchesItself) {
    TriangleMesh touching = square(2);
    touching.faces = {{0, 1, 4}, {0, 4, 3}, {4, 5, 8}, {4, 8, 7}};
    const ExecutionContext context;
    const auto improved = improve(touching, {}, {}, context);
    const auto controlled = control(touching, {}, {}, context);
    for (const auto* refused : {&improved, &controlled}) {
        ASSERT_FALSE(*refused);
        EXPECT_EQ(refused->error().cause, Cause::kNonManifold);
        EXPECT_NE(refused->error().message.find("touches itself at vertex 4"), std::string::npos) << refused->error().message;
        EXPECT_NE(refused->error().message.find("accepted is"), std::string::npos);
    }
}

TEST(OpenBoundaryTest, RealMeshesKeepTheirTopology) {
    for (const char* name : {"open_featuretype.stl", "open_unitree_rubber_hand_70k.stl"}) {
        const auto path = std::filesystem::path(VSPLIT_SHARED_MESHES) / name;
        if (!std::filesystem::exists(path)) continue;
        auto read = read_mesh_file(path, {});
        ASSERT_TRUE(read) << read.error().message;
        const TriangleMesh& source = read->mesh;
        if (!require_manifold(inspect(source))) continue;
        const ExecutionContext context;
        for (const Mode mode : {Mode::kStrict, Mode::kExtended}) {
            const auto result =
                control(source, {.subdivisions = 0, .faces = source.face_count() / 10, .mode = mode}, {}, context);
            ASSERT_TRUE(result) << name << ": " << result.error().message;
            for (const std::size_t level : {std::size_t{0}, result->mrr.level_for(result->faces), result->mrr.levels()}) {
                EXPECT_EQ(topology(mesh_at(result->mrr, level)), topology(source)) << name << " at " << level;
            }
        }
    }
}

}  // namespace
}  // namespace vsplit::test
