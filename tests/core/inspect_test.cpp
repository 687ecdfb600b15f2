#include "vsplit/mesh/inspect.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>

#include "tests/core/meshes.h"
#include "tests/core/random.h"

namespace vsplit {
namespace {

const Finding* find(const MeshReport& report, Finding::Kind kind) {
    const auto found =
        std::find_if(report.findings.begin(), report.findings.end(), [&](const Finding& f) { return f.kind == kind; });
    return found == report.findings.end() ? nullptr : &*found;
}

TEST(InspectTest, KnowsTopologyOfClosedMeshes) {
    const auto expect = [](const TriangleMesh& mesh, std::uint32_t components, std::int32_t genus) {
        const MeshReport report = inspect(mesh);
        EXPECT_TRUE(report.closed);
        EXPECT_EQ(report.components, components);
        EXPECT_EQ(report.genus, genus);
        EXPECT_EQ(report.boundary_edges, 0U);
        EXPECT_TRUE(require_closed_manifold(report));
    };
    expect(test::tetrahedron(), 1, 0);
    expect(test::cube(), 1, 0);
    expect(test::torus(12, 8), 1, 1);
    expect(test::plate_with_holes(3), 1, 3);
    expect(test::cube_frame(), 1, 5);
    expect(test::joined(test::torus(12, 8), test::cube_frame(), Vec3(50, 0, 0)), 2, 6);
    expect(test::sliver_cylinder(40, 10), 1, 0);
}

TEST(InspectTest, AClosedMeshWhoseFacesLookInwardsIsInsideOut) {
    TriangleMesh mesh = test::cube_frame();
    EXPECT_EQ(find(inspect(mesh), Finding::Kind::kInsideOut), nullptr);
    EXPECT_TRUE(require_outward(inspect(mesh)));
    for (Triangle& face : mesh.faces) std::swap(face[1], face[2]);
    const MeshReport report = inspect(mesh);
    const Finding* const finding = find(report, Finding::Kind::kInsideOut);
    ASSERT_NE(finding, nullptr);
    EXPECT_EQ(finding->count, mesh.face_count());
    EXPECT_EQ(finding->places.size(), Finding::kExamples);
    EXPECT_TRUE(require_closed_manifold(report));
    ASSERT_FALSE(require_outward(report));
    EXPECT_EQ(require_outward(report).error().cause, Cause::kNonManifold);
    mesh.faces.pop_back();  // what is open has no inside
    EXPECT_EQ(find(inspect(mesh), Finding::Kind::kInsideOut), nullptr);
}

TEST(InspectTest, TellsWhatAWeldWithAToleranceCost) {
    TriangleMesh mesh = test::cube();
    const Vec3 corner = mesh.positions[mesh.faces[0][0]];
    mesh.positions.push_back(corner + Vec3(1e-4, 0, 0));
    mesh.positions.push_back(corner + Vec3(0, 1e-4, 0));
    mesh.faces.push_back({mesh.faces[0][0], 8, 9});
    mesh.regions.assign(mesh.faces.size(), 5);
    mesh.regions.back() = 7;
    const auto welded = weld(mesh, 1e-3);
    ASSERT_TRUE(welded);
    const MeshReport report = inspect(mesh, *welded);
    const Finding* const merged = find(report, Finding::Kind::kMergedVertex);
    ASSERT_NE(merged, nullptr);
    EXPECT_EQ(merged->count, 2U);
    EXPECT_EQ(merged->places, (std::vector<Vec3>{corner + Vec3(1e-4, 0, 0), corner + Vec3(0, 1e-4, 0)}));
    const Finding* const collapsed = find(report, Finding::Kind::kCollapsedFace);
    ASSERT_NE(collapsed, nullptr);
    EXPECT_EQ(collapsed->places, std::vector<Vec3>{corner});
    const Finding* const emptied = find(report, Finding::Kind::kEmptiedGroup);
    ASSERT_NE(emptied, nullptr);
    EXPECT_NE(emptied->message.find("region 7"), std::string::npos) << emptied->message;
    EXPECT_EQ(find(inspect(mesh, *weld(mesh, 0)), Finding::Kind::kMergedVertex), nullptr);
}

TEST(InspectTest, NamesBoundaryEdges) {
    TriangleMesh mesh = test::icosphere(1);
    mesh.faces.erase(mesh.faces.begin() + 5);
    const MeshReport report = inspect(mesh);
    EXPECT_FALSE(report.closed);
    EXPECT_EQ(report.boundary_edges, 3U);
    const Finding* boundary = find(report, Finding::Kind::kBoundaryEdge);
    ASSERT_NE(boundary, nullptr);
    EXPECT_EQ(boundary->elements.size(), 6U);
    const Status refused = require_closed_manifold(report);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().cause, Cause::kOpenMesh);
    const std::string first = std::to_string(boundary->elements[0]) + "-" + std::to_string(boundary->elements[1]);
    EXPECT_NE(refused.error().message.find(first), std::string::npos) << refused.error().message;
}

TEST(InspectTest, NamesEdgesWithThreeFaces) {
    TriangleMesh mesh = test::tetrahedron();
    mesh.positions.emplace_back(9, 9, 9);
    mesh.faces.push_back({0, 1, 4});
    const MeshReport report = inspect(mesh);
    EXPECT_EQ(report.non_manifold_edges, 1U);
    EXPECT_FALSE(report.closed);
    const Status refused = require_closed_manifold(report);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().cause, Cause::kNonManifold);
    EXPECT_NE(refused.error().message.find("0-1"), std::string::npos);
}

TEST(InspectTest, SeesAFaceTurnedInsideOut) {
    TriangleMesh mesh = test::icosphere(1);
    std::swap(mesh.faces[3][0], mesh.faces[3][1]);
    const MeshReport report = inspect(mesh);
    EXPECT_EQ(report.inconsistent_edges, 3U);
    EXPECT_FALSE(report.closed);
    EXPECT_EQ(require_closed_manifold(report).error().cause, Cause::kNonManifold);
}

TEST(InspectTest, SeesTwoFansAtAVertex) {
    TriangleMesh mesh = test::joined(test::tetrahedron(), test::tetrahedron(), Vec3(10, 0, 0));
    for (Triangle& t : mesh.faces) std::replace(t.begin(), t.end(), 4U, 0U);  // the second body's first vertex is the first's
    const MeshReport report = inspect(mesh);
    EXPECT_EQ(report.non_manifold_vertices, 1U);
    EXPECT_EQ(report.non_manifold_edges, 0U);
    EXPECT_EQ(report.components, 2U);
    const Finding* vertex = find(report, Finding::Kind::kNonManifoldVertex);
    ASSERT_NE(vertex, nullptr);
    EXPECT_EQ(vertex->elements, std::vector<std::uint32_t>{0});
    EXPECT_EQ(require_closed_manifold(report).error().cause, Cause::kNonManifold);
}

TEST(InspectTest, TellsABoundaryThatTouchesItselfFromOtherVerticesOfTwoFans) {
    TriangleMesh touching = test::square(2);
    touching.faces = {{0, 1, 4}, {0, 4, 3}, {4, 5, 8}, {4, 8, 7}};
    const MeshReport report = inspect(touching);
    EXPECT_EQ(report.boundary_touches, std::vector<std::uint32_t>{4});
    const Status refused = require_manifold(report);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().cause, Cause::kNonManifold);
    EXPECT_NE(refused.error().message.find("touches itself at vertex 4; accepted is"), std::string::npos)
        << refused.error().message;

    TriangleMesh body_on_sheet = test::joined(test::square(2), test::tetrahedron(), Vec3(0, 0, 5));
    for (Triangle& t : body_on_sheet.faces) std::replace(t.begin(), t.end(), 9U, 0U);  // a corner of the sheet: one open fan
    EXPECT_EQ(inspect(body_on_sheet).non_manifold_vertices, 1U);
    EXPECT_TRUE(inspect(body_on_sheet).boundary_touches.empty());
    EXPECT_EQ(require_manifold(inspect(body_on_sheet)).error().cause, Cause::kNonManifold);
    EXPECT_TRUE(require_manifold(inspect(test::square(2))));
}

TEST(InspectTest, CountsDegenerateAndDuplicateFaces) {
    TriangleMesh mesh = test::cube();
    mesh.faces.push_back(mesh.faces[4]);
    EXPECT_EQ(inspect(mesh).duplicate_faces, 1U);
    TriangleMesh flat = test::tetrahedron();
    flat.positions[3] = (flat.positions[0] + flat.positions[1]) / 2;
    EXPECT_GE(inspect(flat).degenerate_faces, 1U);
    EXPECT_TRUE(inspect(flat).closed);
}

/// Vertices of several fans, by looking at each pair of corners of a vertex until nothing joins any more.
std::vector<std::uint32_t> several_fans_by_pairs(const TriangleMesh& mesh) {
    std::vector<std::uint32_t> found;
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        std::vector<std::array<std::uint32_t, 2>> others;  // of each corner at v
        for (const Triangle& t : mesh.faces) {
            for (std::size_t c = 0; c < 3; ++c) {
                if (t[c] == v) others.push_back({t[(c + 1) % 3], t[(c + 2) % 3]});
            }
        }
        std::vector<std::size_t> fan(others.size());
        for (std::size_t n = 0; n < fan.size(); ++n) fan[n] = n;
        for (bool changed = true; changed;) {
            changed = false;
            for (std::size_t n = 0; n < fan.size(); ++n) {
                for (std::size_t m = 0; m < fan.size(); ++m) {
                    const bool share = others[n][0] == others[m][0] || others[n][0] == others[m][1] ||
                                       others[n][1] == others[m][0] || others[n][1] == others[m][1];
                    if (!share || fan[n] <= fan[m]) continue;
                    fan[n] = fan[m];
                    changed = true;
                }
            }
        }
        if (!fan.empty() && *std::max_element(fan.begin(), fan.end()) > 0) found.push_back(v);
    }
    return found;
}

std::vector<std::uint32_t> duplicates_by_sorting(const TriangleMesh& mesh) {
    std::set<Triangle> seen;
    std::vector<std::uint32_t> found;
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        Triangle t = mesh.faces[f];
        std::sort(t.begin(), t.end());
        if (!seen.insert(t).second) found.push_back(f);
    }
    return found;
}

void expect_as_by_brute_force(const TriangleMesh& mesh) {
    const MeshReport report = inspect(mesh);
    const std::vector<std::uint32_t> fans = several_fans_by_pairs(mesh), duplicates = duplicates_by_sorting(mesh);
    EXPECT_EQ(report.non_manifold_vertices, fans.size());
    EXPECT_EQ(report.duplicate_faces, duplicates.size());
    const auto expect_first = [&](Finding::Kind kind, std::vector<std::uint32_t> all) {
        all.resize(std::min(all.size(), Finding::kExamples));
        const Finding* finding = find(report, kind);
        EXPECT_EQ(finding == nullptr ? std::vector<std::uint32_t>{} : finding->elements, all);
    };
    expect_first(Finding::Kind::kNonManifoldVertex, fans);
    expect_first(Finding::Kind::kDuplicateFace, duplicates);
}

/// Vertices at random made one.
TriangleMesh pinched(TriangleMesh mesh, int times, std::uint64_t seed) {
    test::Random random(seed);
    const auto any = [&] { return static_cast<std::uint32_t>(random.uniform(0, mesh.vertex_count())); };
    for (int n = 0; n < times; ++n) {
        const std::uint32_t from = any(), to = any();
        for (Triangle& t : mesh.faces) {
            for (std::uint32_t& v : t) v = v == from ? to : v;
        }
    }
    std::erase_if(mesh.faces, [](const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
    return mesh;
}

TEST(InspectTest, FansAndDuplicatesAreThoseOfBruteForce) {
    test::Random random(3);
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        TriangleMesh mesh = pinched(test::punctured(test::icosphere(2), {3, 50}), static_cast<int>(seed % 5), seed);
        expect_as_by_brute_force(mesh);
        for (std::uint64_t n = 0; n < seed % 4; ++n) mesh.faces.push_back(mesh.faces[7 * n]);
        if (seed % 2 == 0) std::swap(mesh.faces[20][0], mesh.faces[20][1]);
        expect_as_by_brute_force(mesh);
        TriangleMesh soup{mesh.positions, {}};  // of few vertices: all kinds of edges
        for (int n = 0; n < 60; ++n) {
            const auto any = [&] { return static_cast<std::uint32_t>(random.uniform(0, 12)); };
            const std::uint32_t a = any();
            soup.faces.push_back({a, (a + 1 + any() % 5) % 12, (a + 6 + any() % 5) % 12});
        }
        expect_as_by_brute_force(soup);
    }
}

TEST(InspectTest, SaysWhatTheWeldDropped) {
    const MeshReport report = inspect(test::cube(), {.merged_vertices = 5, .unused_vertices = 2, .collapsed_faces = 3});
    const Finding* faces = find(report, Finding::Kind::kCollapsedFace);
    ASSERT_NE(faces, nullptr);
    EXPECT_EQ(faces->count, 3U);
    ASSERT_NE(find(report, Finding::Kind::kUnusedVertex), nullptr);
    EXPECT_TRUE(inspect(test::cube()).findings.empty());
}

TEST(InspectTest, AnEmptyMeshIsRefusedAsEmpty) {
    const MeshReport report = inspect({});
    EXPECT_FALSE(report.closed);
    EXPECT_EQ(require_closed_manifold(report).error().cause, Cause::kEmptyInput);
}

TEST(InspectTest, IsBlindToOrder) {
    for (const test::NamedMesh& m : test::small_meshes()) {
        SCOPED_TRACE(m.name);
        const MeshReport before = inspect(m.mesh);
        const MeshReport after = inspect(test::shuffled(m.mesh, 3));
        EXPECT_EQ(after.closed, before.closed);
        EXPECT_EQ(after.components, before.components);
        EXPECT_EQ(after.genus, before.genus);
        EXPECT_EQ(after.quality.valence_max, before.quality.valence_max);
        EXPECT_EQ(after.quality.stretch_histogram, before.quality.stretch_histogram);
    }
}

}  // namespace
}  // namespace vsplit
