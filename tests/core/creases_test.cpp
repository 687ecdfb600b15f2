#include "vsplit/features/creases.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <set>

#include "mesh/half_edges.h"
#include "mesh/spatial_order.h"
#include "tests/core/meshes.h"
#include "vsplit/features/normal_voting.h"
#include "vsplit/io/read_mesh.h"
#include "vsplit/method/improve.h"

namespace vsplit {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

std::vector<SharpEdge> creases_of(const TriangleMesh& mesh, const FeatureOptions& options) {
    return find_creases(mesh, face_normals(mesh), options);
}

FeatureOptions voting() {
    FeatureOptions options;
    options.detection = FeatureDetection::kNormalVoting;
    return options;
}

std::map<Edge, double> by_ends(const std::vector<SharpEdge>& edges) {
    std::map<Edge, double> all;
    for (const SharpEdge& edge : edges) all[std::minmax(edge.a, edge.b)] = edge.weight;
    EXPECT_EQ(all.size(), edges.size()) << "an edge is there twice";
    return all;
}

/// Length of edges whose middle is near an edge of the unit cube, and of the others.
struct CubeLengths {
    double near = 0;
    double elsewhere = 0;
};

CubeLengths cube_lengths(const TriangleMesh& mesh, const std::vector<SharpEdge>& edges, double reach) {
    CubeLengths lengths;
    for (const SharpEdge& edge : edges) {
        const Vec3 middle = (mesh.positions[edge.a] + mesh.positions[edge.b]) / 2;
        int sides = 0;
        for (const double x : middle) sides += std::min(std::abs(x), std::abs(x - 1)) < reach ? 1 : 0;
        (sides >= 2 ? lengths.near : lengths.elsewhere) += (mesh.positions[edge.a] - mesh.positions[edge.b]).norm();
    }
    return lengths;
}

TEST(CreasesTest, DihedralIsWhatFindSharpEdgesFinds) {
    for (const test::NamedMesh& m : test::small_meshes()) {
        SCOPED_TRACE(m.name);
        const FaceNormals normals = face_normals(m.mesh);
        const auto found = find_creases(m.mesh, normals, {});
        const auto sharp = find_sharp_edges(m.mesh, normals, {});
        ASSERT_EQ(found.size(), sharp.size());
        for (std::size_t i = 0; i < sharp.size(); ++i) {
            EXPECT_EQ(found[i].a, sharp[i].a);
            EXPECT_EQ(found[i].b, sharp[i].b);
            EXPECT_EQ(found[i].weight, sharp[i].weight);
        }
    }
}

TEST(CreasesTest, BoundariesAreCreasesForEitherDetection) {
    TriangleMesh open = test::icosphere(2);
    const Triangle gone = open.faces.back();
    open.faces.pop_back();
    for (const FeatureOptions& options : {FeatureOptions(), voting()}) {
        const auto edges = by_ends(creases_of(open, options));
        ASSERT_EQ(edges.size(), 3U);
        for (std::size_t i = 0; i < 3; ++i) {
            const auto found = edges.find(std::minmax(gone[i], gone[(i + 1) % 3]));
            ASSERT_NE(found, edges.end());
            EXPECT_EQ(found->second, options.weight);
        }
    }
}

TEST(CreasesTest, MarkedEdgesAndBordersOfRegionsJoin) {
    const TriangleMesh mesh = test::icosphere(1);
    FeatureOptions options;
    const Triangle& first = mesh.faces[0];
    options.marked_edges = {first[1], first[0], first[0], first[1]};  // either way round, and twice
    options.regions.assign(mesh.faces.size(), 3);
    options.regions[20] = 4;
    const auto edges = by_ends(creases_of(mesh, options));
    EXPECT_EQ(edges.size(), 4U);
    EXPECT_EQ(edges.at(std::minmax(first[0], first[1])), options.weight);
    const Triangle& island = mesh.faces[20];
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(edges.at(std::minmax(island[i], island[(i + 1) % 3])), options.weight);
}

TEST(CreasesTest, TheHeavierOfTwoReasonsCounts) {
    const TriangleMesh mesh = test::tetrahedron();  // its three obtuse edges weigh more than a marked one
    FeatureOptions options;
    const auto found = by_ends(creases_of(mesh, options));
    for (const auto& [ends, weight] : found) options.marked_edges.insert(options.marked_edges.end(), {ends.first, ends.second});
    EXPECT_EQ(by_ends(creases_of(mesh, options)), [&] {
        auto expected = found;
        for (auto& [ends, weight] : expected) weight = std::max(weight, options.weight);
        return expected;
    }());
}

void expect_refused(const Status& status, const std::string& field, const std::string& part) {
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().cause, Cause::kInvalidOption);
    EXPECT_EQ(status.error().field, field);
    EXPECT_NE(status.error().message.find(part), std::string::npos) << status.error().message;
    EXPECT_NE(status.error().message.find("accepted"), std::string::npos) << status.error().message;
}

TEST(CreasesTest, RefusesWhatDoesNotFitTheMesh) {
    const TriangleMesh mesh = test::cube();
    EXPECT_TRUE(check_features(mesh, {}, {}));
    EXPECT_TRUE(check_features(mesh, {mesh.faces[3][0], mesh.faces[3][1]}, std::vector<std::uint32_t>(12, 9)));
    expect_refused(check_features(mesh, {0, 1, 2}, {}), "marked_edges", "3 numbers");
    expect_refused(check_features(mesh, {mesh.faces[0][0], mesh.faces[0][1], 1, 8}, {}), "marked_edges", "pair 1 is (1, 8)");
    const Vec3 far = Vec3::Ones() - mesh.positions[0];  // the opposite corner of the cube: no edge leads there
    const auto opposite =
        static_cast<std::uint32_t>(std::find(mesh.positions.begin(), mesh.positions.end(), far) - mesh.positions.begin());
    expect_refused(check_features(mesh, {0, opposite}, {}), "marked_edges", "pair 0 is (0, " + std::to_string(opposite) + ")");
    expect_refused(check_features(mesh, {0, 0}, {}), "marked_edges", "pair 0 is (0, 0)");
    expect_refused(check_features(mesh, {}, {1, 2, 3}), "regions", "3 ids; accepted is one for each of the 12");
}

TEST(CreasesTest, VotingFindsNearlyNothingOnANoisySphere) {
    const TriangleMesh noisy = test::bumpy_sphere(5, 0.01, 1);  // noise of a third of an edge
    const std::size_t by_angle = creases_of(noisy, {}).size();
    const std::size_t by_vote = creases_of(noisy, voting()).size();
    EXPECT_GT(by_angle, 500U);
    EXPECT_LE(by_vote, by_angle / 50);
    EXPECT_TRUE(creases_of(test::bumpy_sphere(5, 0.005, 2), voting()).empty());
}

TEST(CreasesTest, VotingStandsTheNoiseOfAScan) {
    const auto scan = read_mesh_file(test::data_file("scan.ply"), {});
    ASSERT_TRUE(scan);
    const std::size_t by_angle = creases_of(scan->mesh, {}).size();
    EXPECT_GT(by_angle, 2000U);
    EXPECT_LE(creases_of(scan->mesh, voting()).size(), by_angle / 20);
}

TEST(CreasesTest, VotingFindsTheEdgesOfANoisyCubeAsLines) {
    for (const double noise : {0.0, 0.1, 0.2}) {
        SCOPED_TRACE(noise);
        const TriangleMesh cube = test::noisy_cube(24, noise, 7);
        const auto edges = creases_of(cube, voting());
        const CubeLengths lengths = cube_lengths(cube, edges, 0.5 / 24);
        EXPECT_GE(lengths.near, 11.5);
        EXPECT_LE(lengths.near, 12.7) << "more than one line along an edge";
        EXPECT_LE(lengths.elsewhere, 0.25);
    }
    // The dihedral test sees the noise too.
    const TriangleMesh cube = test::noisy_cube(24, 0.2, 7);
    EXPECT_GT(cube_lengths(cube, creases_of(cube, {}), 0.5 / 24).elsewhere, 2);
}

TEST(CreasesTest, VotingTellsVerticesApart) {
    const std::uint32_t n = 16;
    const TriangleMesh cube = test::noisy_cube(n, 0, 1);
    const VotedNormals voted = vote_normals(cube, face_normals(cube), {});
    for (std::uint32_t v = 0; v < cube.vertex_count(); ++v) {
        int sides = 0;
        bool near = false;
        for (const double x : cube.positions[v]) {
            const double off = std::min(x, 1 - x);
            sides += off == 0 ? 1 : 0;
            near = near || (off > 0 && off < 3.5 / n);
        }
        const bool surface = voted.vertices[v] == VertexKind::kSurface;
        EXPECT_TRUE(sides != 3 || voted.vertices[v] == VertexKind::kCorner) << v;
        EXPECT_TRUE(sides < 2 || !surface) << v;
        EXPECT_TRUE(sides > 1 || near || surface) << v;
    }
    for (const Vec3& normal : voted.normals) EXPECT_NEAR(normal.cwiseAbs().maxCoeff(), 1, 1e-3) << "a voted normal is a side's";
}

TEST(CreasesTest, VotingIsNotFooledByCoarseCurvature) {
    for (unsigned subdivisions = 1; subdivisions < 4; ++subdivisions) {
        EXPECT_TRUE(creases_of(test::icosphere(subdivisions), voting()).empty()) << subdivisions;
    }
    EXPECT_TRUE(creases_of(test::torus(40, 20), voting()).empty());
}

TEST(CreasesTest, VotingIsTheSameForAnyNumberOfThreads) {
    const TriangleMesh mesh = test::bumpy_sphere(4, 0.02, 3);
    const FaceNormals normals = face_normals(mesh);
    tbb::task_arena one(1);
    const VotedNormals alone = one.execute([&] { return vote_normals(mesh, normals, {}); });
    const VotedNormals together = vote_normals(mesh, normals, {});
    EXPECT_EQ(alone.normals, together.normals);
    EXPECT_EQ(alone.vertices, together.vertices);
}

/// The pieces of each crease cover it, have its weight, and nothing else is a crease.
void expect_covers(const TriangleMesh& source, const std::vector<SharpEdge>& creases, const SubdividedMesh& fine) {
    const auto pieces = creases_on(fine, source, creases);
    const auto length = [](const TriangleMesh& mesh, const std::vector<SharpEdge>& edges) {
        double sum = 0;
        for (const SharpEdge& edge : edges) sum += edge.weight * (mesh.positions[edge.a] - mesh.positions[edge.b]).norm();
        return sum;
    };
    EXPECT_NEAR(length(fine.mesh, pieces), length(source, creases), 1e-9 * (1 + length(source, creases)));
    std::set<std::pair<Edge, double>> once;
    for (const SharpEdge& edge : pieces) EXPECT_TRUE(once.insert({std::minmax(edge.a, edge.b), 0}).second);
}

TEST(CreasesTest, SubdivisionKeepsThemWhereTheyAre) {
    const ExecutionContext context;
    for (const test::NamedMesh& m : test::small_meshes()) {
        SCOPED_TRACE(m.name);
        FeatureOptions options;
        options.regions.assign(m.mesh.faces.size(), 0);
        for (std::size_t f = 0; f < options.regions.size(); f += 5) options.regions[f] = 1;
        const auto creases = creases_of(m.mesh, options);
        ASSERT_FALSE(creases.empty());
        auto fine = subdivide_to_size(m.mesh, 0.3 * measure_quality(m.mesh).size_max, 1'000'000, context);
        ASSERT_TRUE(fine);
        expect_covers(m.mesh, creases, *fine);
        order_spatially(*fine);
        expect_covers(m.mesh, creases, *fine);
    }
}

TEST(CreasesTest, SubdivisionKeepsTheDihedralOnesBitForBit) {
    const ExecutionContext context;
    for (const test::NamedMesh& m : test::small_meshes()) {
        SCOPED_TRACE(m.name);
        const FaceNormals normals = face_normals(m.mesh);
        const auto fine = subdivide_one_to_four(m.mesh, 1, 1'000'000, context);
        ASSERT_TRUE(fine);
        FaceNormals inherited;
        for (const std::uint32_t p : fine->parent) {
            inherited.normals.push_back(normals.normals[p]);
            inherited.reliable.push_back(normals.reliable[p]);
        }
        const auto direct = find_sharp_edges(fine->mesh, inherited, {});
        const auto carried = creases_on(*fine, m.mesh, find_creases(m.mesh, normals, {}));
        ASSERT_EQ(carried.size(), direct.size());
        for (std::size_t i = 0; i < direct.size(); ++i) {
            EXPECT_EQ(carried[i].a, direct[i].a);
            EXPECT_EQ(carried[i].b, direct[i].b);
            EXPECT_EQ(carried[i].weight, direct[i].weight);
        }
    }
}

TEST(CreasesTest, MethodsUseThemAndRefuseWhatDoesNotFit) {
    const TriangleMesh mesh = test::icosphere(3);
    ImproveOptions options;
    options.faces = 300;
    options.marked_edges = {0, 0};
    const ExecutionContext context;
    const auto refused = improve(mesh, options, {}, context);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().field, "marked_edges");
    options.marked_edges.clear();
    const auto plain = improve(mesh, options, {}, context);
    for (const Triangle& t : mesh.faces) {  // the halves of the sphere as regions
        const Vec3 middle = mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]];
        options.regions.push_back(middle.z() > 0 ? 1 : 0);
    }
    const auto cut = improve(mesh, options, {}, context);
    ASSERT_TRUE(plain && cut);
    EXPECT_FALSE(plain->mrr.base == cut->mrr.base) << "regions made no difference";
}

}  // namespace
}  // namespace vsplit
