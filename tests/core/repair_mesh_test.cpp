#include "vsplit/repair/repair_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "tests/core/meshes.h"
#include "tests/core/random.h"
#include "vsplit/io/read_mesh.h"
#include "vsplit/quality/deviation.h"

namespace vsplit {
namespace {

using Kind = Finding::Kind;

std::uint32_t count(const std::vector<Finding>& findings, Kind kind) {
    const auto found = std::find_if(findings.begin(), findings.end(), [&](const Finding& f) { return f.kind == kind; });
    return found == findings.end() ? 0 : found->count;
}

RepairedMesh repaired(const TriangleMesh& mesh, const RepairOptions& options) {
    Expected<RepairedMesh> result = repair_mesh(mesh, options);
    EXPECT_TRUE(result);
    EXPECT_EQ(result->parent.size(), result->mesh.faces.size());
    for (const std::uint32_t parent : result->parent) EXPECT_LT(parent, mesh.face_count());
    for (const Finding& finding : result->findings) {
        EXPECT_FALSE(finding.message.empty());
        const bool change = finding.kind >= Kind::kMergedVertex;
        EXPECT_EQ(finding.places.size(), change ? finding.count : std::min<std::size_t>(finding.count, Finding::kExamples));
    }
    return *std::move(result);
}

constexpr RepairOptions kSafe{.mode = RepairMode::kSafe};
constexpr RepairOptions kFull{.mode = RepairMode::kFull};

/// Two unit cubes with an edge in common, welded: four faces at it.
TriangleMesh cubes_at_an_edge() {
    TriangleMesh mesh = test::joined(test::cube(), test::cube(), Vec3(1, 1, 0));
    EXPECT_TRUE(weld(mesh, 0));
    return mesh;
}

TEST(RepairMeshTest, NoneChangesNothingAndSaysWhatStandsInTheWay) {
    const TriangleMesh mesh = cubes_at_an_edge();
    const RepairedMesh same = repaired(mesh, {});
    EXPECT_EQ(same.mesh, mesh);
    EXPECT_EQ(count(same.findings, Kind::kNonManifoldEdge), 1U);
    const TriangleMesh crossing = test::joined(test::icosphere(2), test::icosphere(2), Vec3(0.7, 0.3, 0.2));
    EXPECT_GT(count(repaired(crossing, {}).findings, Kind::kSelfIntersection), 20U);
}

TEST(RepairMeshTest, GoodMeshesStayAsTheyAre) {
    for (const auto& [name, mesh] : test::small_meshes()) {
        for (const RepairOptions& options : {kSafe, kFull}) {
            const RepairedMesh same = repaired(mesh, options);
            EXPECT_EQ(same.mesh, mesh) << name;
            EXPECT_TRUE(same.findings.empty()) << name << ": " << same.findings[0].message;
        }
    }
}

TEST(RepairMeshTest, BodiesThatTouchAreCutApart) {
    const RepairedMesh apart = repaired(cubes_at_an_edge(), kSafe);
    const MeshReport report = inspect(apart.mesh);
    EXPECT_TRUE(report.closed);
    EXPECT_EQ(report.components, 2U) << "those faces stay together that have a body between them";
    EXPECT_EQ(report.vertices, 16U);
    EXPECT_NEAR(enclosed_volume(apart.mesh), 2, 1e-12);
    EXPECT_EQ(count(apart.findings, Kind::kSplitEdge), 1U);
    EXPECT_EQ(count(apart.findings, Kind::kSplitVertex), 2U);
    EXPECT_EQ(apart.findings[0].places[0].head<2>(), Eigen::Vector2d(1, 1)) << apart.findings[0].message;
}

TEST(RepairMeshTest, AnEdgeWhoseEndsStayWholeGetsAMiddle) {
    // A ring of cubes around a square hole, two corners of the ring touching along one edge only.
    TriangleMesh mesh;
    for (const Vec3& at : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 1, 0), Vec3(2, 2, 0), Vec3(1, 2, 0), Vec3(0, 1, 0)}) {
        mesh = test::joined(mesh, test::cube(), at);
    }
    ASSERT_TRUE(weld(mesh, 0));
    const RepairedMesh whole = repaired(mesh, kSafe);
    const MeshReport report = inspect(whole.mesh);
    EXPECT_TRUE(report.closed) << report.findings[0].message;
    EXPECT_NEAR(enclosed_volume(whole.mesh), 6, 1e-12);
}

TEST(RepairMeshTest, WallsOfNoThicknessGoAndSheetsStay) {
    const TriangleMesh stacked = test::joined(test::cube(), test::cube(), Vec3(1, 0, 0));
    TriangleMesh welded = stacked;
    ASSERT_TRUE(weld(welded, 0));
    const RepairedMesh one = repaired(welded, kSafe);
    EXPECT_EQ(count(one.findings, Kind::kDroppedDuplicate), 4U);
    EXPECT_TRUE(inspect(one.mesh).closed);
    EXPECT_NEAR(enclosed_volume(one.mesh), 2, 1e-12);

    TriangleMesh sheet = test::square(4);
    const std::uint32_t faces = sheet.face_count();
    for (std::uint32_t f = 0; f < faces; ++f) {
        const Triangle t = sheet.faces[f];
        sheet.faces.push_back({t[0], t[2], t[1]});
    }
    const RepairedMesh single = repaired(sheet, kSafe);
    EXPECT_EQ(single.mesh, test::square(4));
    EXPECT_EQ(count(single.findings, Kind::kDroppedDuplicate), faces);
}

TEST(RepairMeshTest, ACopyThatLooksTheOtherWayTearsNoHole) {
    const TriangleMesh good = test::icosphere(2);
    for (const std::uint32_t copies : {1U, 7U, 40U}) {
        for (const bool first : {false, true}) {
            TriangleMesh mesh = good;
            for (std::uint32_t f = 0; f < copies; ++f) {
                const Triangle t = good.faces[f];
                mesh.faces.insert(first ? mesh.faces.begin() : mesh.faces.end(), {t[0], t[2], t[1]});
            }
            for (const RepairOptions& options : {kSafe, kFull}) {
                const RepairedMesh whole = repaired(mesh, options);
                EXPECT_TRUE(inspect(whole.mesh).closed) << copies;
                EXPECT_EQ(whole.mesh.face_count(), good.face_count());
                EXPECT_EQ(count(whole.findings, Kind::kDroppedDuplicate), copies);
                const std::uint32_t turned = count(whole.findings, Kind::kTurnedFace);
                EXPECT_EQ(turned, copies == 1 ? 0U : turned) << "the copy that agrees was kept";
                EXPECT_NEAR(enclosed_volume(whole.mesh), enclosed_volume(good), 1e-12);
            }
        }
    }
    // On an open surface too, at its border; and a fin on a closed one still goes.
    TriangleMesh sheet = test::square(3);
    const Triangle t = sheet.faces[0];
    sheet.faces.push_back({t[0], t[2], t[1]});
    EXPECT_EQ(repaired(sheet, kSafe).mesh, test::square(3));
    TriangleMesh finned = good;
    const Triangle base = finned.faces[5];
    finned.positions.push_back(2 * finned.positions[base[0]]);
    finned.faces.push_back({base[0], base[1], good.vertex_count()});
    finned.faces.push_back({base[1], base[0], good.vertex_count()});
    EXPECT_EQ(repaired(finned, kSafe).mesh, good);
}

const Finding* find(const std::vector<Finding>& findings, Kind kind) {
    const auto found = std::find_if(findings.begin(), findings.end(), [&](const Finding& f) { return f.kind == kind; });
    return found == findings.end() ? nullptr : &*found;
}

/// A cube whose face 0 is there twice, the first of region `kept` and the second of `dropped`; the others are of region 0.
TriangleMesh cube_with_copy(std::uint32_t kept, std::uint32_t dropped, std::vector<FaceSet> sets) {
    TriangleMesh mesh = test::cube();
    mesh.regions.assign(mesh.faces.size(), 0);
    mesh.regions[0] = kept;
    mesh.faces.push_back(mesh.faces[0]);
    mesh.regions.push_back(dropped);
    mesh.sets = std::move(sets);
    return mesh;
}

TEST(RepairMeshTest, TheKeptCopyGoesIntoTheSetsOfBoth) {
    const auto has_face = [](const TriangleMesh& mesh, std::size_t set, std::uint32_t face) {
        const auto& regions = mesh.sets[set].regions;
        return std::find(regions.begin(), regions.end(), mesh.regions[face]) != regions.end();
    };
    for (const RepairOptions& options : {kSafe, kFull}) {
        const RepairedMesh both = repaired(cube_with_copy(1, 2, {{"left", {1}}, {"right", {2}}, {"rest", {0}}}), options);
        EXPECT_EQ(count(both.findings, Kind::kDroppedDuplicate), 1U);
        EXPECT_TRUE(has_face(both.mesh, 0, 0));
        EXPECT_TRUE(has_face(both.mesh, 1, 0));
        EXPECT_FALSE(has_face(both.mesh, 2, 0));
        EXPECT_TRUE(has_face(both.mesh, 2, 1));
        EXPECT_EQ(count(both.findings, Kind::kLostFace), 0U);
        EXPECT_EQ(count(both.findings, Kind::kEmptiedGroup), 0U);
        // A region that is in the sets of both is there already, and one whose sets the kept one has too adds nothing.
        const RepairedMesh known = repaired(cube_with_copy(1, 2, {{"left", {1, 3}}, {"right", {3, 2}}}), options);
        EXPECT_EQ(known.mesh.regions[0], 3U);
        const RepairedMesh within = repaired(cube_with_copy(1, 2, {{"all", {1, 2}}, {"left", {1}}}), options);
        EXPECT_EQ(within.mesh.regions[0], 1U);
    }
    const RepairedMesh last = repaired(cube_with_copy(0xFFFFFFFF, 2, {{"left", {0xFFFFFFFF}}, {"right", {2}}}), kSafe);
    EXPECT_EQ(last.mesh.regions[0], 1U) << "the first number that is free";
}

TEST(RepairMeshTest, WhatARegionLosesToACopyIsTold) {
    // Of two regions in no set a face can have one.
    const RepairedMesh lone = repaired(cube_with_copy(1, 2, {}), kSafe);
    EXPECT_EQ(lone.mesh.regions[0], 1U);
    ASSERT_EQ(count(lone.findings, Kind::kLostFace), 1U);
    EXPECT_NE(find(lone.findings, Kind::kLostFace)->message.find("1 of region 2"), std::string::npos);
    EXPECT_EQ(find(lone.findings, Kind::kLostFace)->elements, std::vector<std::uint32_t>{12});
    ASSERT_EQ(count(lone.findings, Kind::kEmptiedGroup), 1U);
    EXPECT_NE(find(lone.findings, Kind::kEmptiedGroup)->message.find("1 of region 2"), std::string::npos);
    // A set is what a person named: it keeps the face, and region 0 in no set is no group that could lose one.
    const RepairedMesh named = repaired(cube_with_copy(0, 2, {{"right", {2}}}), kSafe);
    EXPECT_EQ(named.mesh.regions[0], 2U);
    EXPECT_EQ(count(named.findings, Kind::kLostFace), 0U);
    EXPECT_EQ(count(named.findings, Kind::kEmptiedGroup), 0U);
    // A wall of no thickness goes with its group.
    TriangleMesh stacked = test::joined(test::cube(), test::cube(), Vec3(1, 0, 0));
    ASSERT_TRUE(weld(stacked, 0));
    const RepairedMesh wall = repaired(stacked, kSafe);
    stacked.regions.assign(stacked.faces.size(), 1);
    for (const std::uint32_t face : find(wall.findings, Kind::kDroppedDuplicate)->elements) stacked.regions[face] = 5;
    stacked.sets = {{"wall", {5}}};
    const RepairedMesh without = repaired(stacked, kSafe);
    ASSERT_EQ(count(without.findings, Kind::kLostFace), 4U);
    EXPECT_NE(find(without.findings, Kind::kEmptiedGroup)->message.find("4 of 'wall'"), std::string::npos);
}

TEST(RepairMeshTest, AGroupThatGoesWithASpeckIsTold) {
    TriangleMesh mesh = test::joined(test::cube(), test::cube(), Vec3(3, 0, 0));
    for (std::size_t v = test::cube().positions.size(); v < mesh.positions.size(); ++v)
        mesh.positions[v] = Vec3(3, 0, 0) + 1e-4 * (mesh.positions[v] - Vec3(3, 0, 0));
    mesh.regions.assign(mesh.faces.size(), 1);
    std::fill(mesh.regions.begin() + 12, mesh.regions.end(), 2);
    mesh.sets = {{"body", {1}}, {"crumb", {2}}};
    const RepairedMesh clean = repaired(mesh, kFull);
    EXPECT_EQ(count(clean.findings, Kind::kDroppedSpeck), 1U);
    ASSERT_EQ(count(clean.findings, Kind::kEmptiedGroup), 1U);
    EXPECT_NE(find(clean.findings, Kind::kEmptiedGroup)->message.find("12 of 'crumb'"), std::string::npos);
}

TEST(RepairMeshTest, AFaceWithoutAreaThatHangsOnABodyGoes) {
    TriangleMesh mesh = test::cube();
    const Triangle t = mesh.faces[0];
    mesh.positions.push_back((mesh.positions[t[0]] + mesh.positions[t[1]]) / 2);
    mesh.positions.push_back((mesh.positions[t[0]] + mesh.positions[8]) / 2);
    mesh.faces.push_back({t[0], 8, t[1]});
    mesh.faces.push_back({t[0], 9, 8});  // hangs on the one that hangs
    for (const RepairOptions& options : {kSafe, kFull}) {
        const RepairedMesh clean = repaired(mesh, options);
        EXPECT_EQ(clean.mesh, test::cube());
        EXPECT_EQ(count(clean.findings, Kind::kFlattenedFace), 2U);
    }
}

TEST(RepairMeshTest, FacesAreTurnedToAgree) {
    TriangleMesh mesh = test::torus(20, 10);
    test::Random random(1);
    std::uint32_t turned = 0;
    for (Triangle& t : mesh.faces) {
        if (random.uniform(0, 1) > 0.3) continue;
        std::swap(t[0], t[1]);
        ++turned;
    }
    const RepairedMesh same = repaired(mesh, kSafe);
    EXPECT_EQ(count(same.findings, Kind::kTurnedFace), turned);
    EXPECT_TRUE(inspect(same.mesh).closed);
    EXPECT_NEAR(enclosed_volume(same.mesh), enclosed_volume(test::torus(20, 10)), 1e-12);

    for (Triangle& t : mesh.faces) std::swap(t[0], t[1]);  // now most look inwards
    EXPECT_LT(enclosed_volume(repaired(mesh, kSafe).mesh), 0);
    EXPECT_GT(enclosed_volume(repaired(mesh, kFull).mesh), 0);
}

TEST(RepairMeshTest, AMoebiusBandIsCut) {
    TriangleMesh band;
    constexpr std::uint32_t kAround = 12;
    for (std::uint32_t i = 0; i < kAround; ++i) {
        const double angle = 2 * 3.141592653589793 * i / kAround;
        const Vec3 radial(std::cos(angle), std::sin(angle), 0);
        const Vec3 across = 0.2 * (std::cos(angle / 2) * radial + std::sin(angle / 2) * Vec3::UnitZ());
        band.positions.push_back(radial - across);
        band.positions.push_back(radial + across);
    }
    for (std::uint32_t i = 0; i < kAround; ++i) {
        const std::uint32_t a = 2 * i;
        const bool last = i + 1 == kAround;
        const std::uint32_t c = last ? 1 : a + 2;
        const std::uint32_t d = last ? 0 : a + 3;
        band.faces.push_back({a, c, d});
        band.faces.push_back({a, d, a + 1});
    }
    ASSERT_GT(inspect(band).inconsistent_edges, 0U);
    const RepairedMesh cut = repaired(band, kSafe);
    EXPECT_TRUE(require_manifold(inspect(cut.mesh)));
    EXPECT_GT(count(cut.findings, Kind::kSplitEdge), 0U);
    EXPECT_NEAR(surface_area(cut.mesh), surface_area(band), 1e-12);
}

TEST(RepairMeshTest, FacesWithoutAreaGo) {
    TriangleMesh mesh = test::cube();
    // A vertex in the middle of an edge, in one of its faces only: the other side is closed by a face without area.
    const Triangle t = mesh.faces[0];
    const std::uint32_t middle = mesh.vertex_count();
    mesh.positions.push_back((mesh.positions[t[0]] + mesh.positions[t[1]]) / 2);
    mesh.faces[0] = {t[0], middle, t[2]};
    mesh.faces.push_back({middle, t[1], t[2]});
    mesh.faces.push_back({t[0], t[1], middle});
    ASSERT_EQ(inspect(mesh).degenerate_faces, 1U);
    ASSERT_TRUE(inspect(mesh).closed);
    const RepairedMesh better = repaired(mesh, kSafe);
    EXPECT_EQ(count(better.findings, Kind::kFlattenedFace), 1U);
    const MeshReport report = inspect(better.mesh);
    EXPECT_TRUE(report.closed);
    EXPECT_EQ(report.degenerate_faces, 0U);
    EXPECT_NEAR(surface_area(better.mesh), 6, 1e-12);
}

TEST(RepairMeshTest, SmallHolesAreFilledAndRimsAreNot) {
    const TriangleMesh sphere = test::icosphere(4);
    const RepairedMesh filled = repaired(test::punctured(sphere, {0, 700}), {.mode = RepairMode::kFull, .hole_size = 0.5});
    EXPECT_EQ(count(filled.findings, Kind::kFilledHole), 2U);
    EXPECT_TRUE(inspect(filled.mesh).closed);
    EXPECT_EQ(filled.mesh.vertex_count(), sphere.vertex_count() - 2);
    EXPECT_NEAR(enclosed_volume(filled.mesh), enclosed_volume(sphere), 0.01);
    const RepairedMesh open = repaired(test::hemisphere(40, 10), {.mode = RepairMode::kFull, .hole_size = 100});
    EXPECT_EQ(count(open.findings, Kind::kFilledHole), 0U);
    EXPECT_EQ(open.mesh, test::hemisphere(40, 10));
}

TEST(RepairMeshTest, AHoleAlongALineIsClosedWithoutAFaceOfNoArea) {
    TriangleMesh mesh = test::icosphere(2);
    const Triangle whole = mesh.faces[0];
    const std::uint32_t middle = mesh.vertex_count();
    mesh.positions.push_back((mesh.positions[whole[0]] + mesh.positions[whole[1]]) / 2);
    mesh.faces[0] = {whole[0], middle, whole[2]};
    mesh.faces.push_back({middle, whole[1], whole[2]});
    const RepairedMesh closed = repaired(mesh, {.mode = RepairMode::kFull, .stitch = 0, .hole_size = 1});
    EXPECT_EQ(count(closed.findings, Kind::kFilledHole), 1U);
    EXPECT_EQ(count(closed.findings, Kind::kDegenerateFace), 0U);
    EXPECT_TRUE(inspect(closed.mesh).closed);
}

TEST(RepairMeshTest, AHoleAroundAnEdgeOfOthersIsFilledWithoutMakingItTwice) {
    // A square hole whose one diagonal is an edge elsewhere, under it.
    TriangleMesh mesh;
    mesh.positions = {{0, 0, 0},     {1, 0, 0},    {1, 1, 0},    {0, 1, 0},    {0.5, 0.5, -1},
                      {0.5, -3, -2}, {4, 0.5, -2}, {0.5, 4, -2}, {-3, 0.5, -2}};
    for (std::uint32_t i = 0; i < 4; ++i) {
        const std::uint32_t j = (i + 1) % 4;
        mesh.faces.push_back({j, i, 5 + i});
        mesh.faces.push_back({j, 5 + i, 5 + j});
    }
    mesh.faces.push_back({0, 2, 4});
    const RepairedMesh filled = repaired(mesh, {.mode = RepairMode::kFull, .stitch = 0, .hole_size = 2});
    EXPECT_TRUE(require_manifold(inspect(filled.mesh)));
}

TEST(RepairMeshTest, SpecksAreDroppedButNeverAll) {
    const TriangleMesh with_speck = test::joined(test::icosphere(2), test::tetrahedron(), Vec3(5, 0, 0));
    const RepairedMesh clean = repaired(with_speck, {.mode = RepairMode::kFull, .speck_size = 3});
    EXPECT_EQ(count(clean.findings, Kind::kDroppedSpeck), 1U);
    EXPECT_EQ(clean.mesh, test::icosphere(2));
    EXPECT_EQ(repaired(with_speck, {.mode = RepairMode::kFull, .speck_size = 100}).mesh, test::icosphere(2));
}

/// A torus cut into its faces, of which some are cut in two at an edge that the neighbour does not know of, all moved by noise.
TriangleMesh cracked_torus(double noise, std::uint64_t seed) {
    test::Random random(seed);
    const TriangleMesh torus = test::torus(24, 12);
    TriangleMesh cracked;
    const auto add = [&](const Vec3& at) {
        const Vec3 moved = at + noise * Vec3(random.uniform(0, 1) - 0.5, random.uniform(0, 1) - 0.5, random.uniform(0, 1) - 0.5);
        cracked.positions.push_back(moved);
        return cracked.vertex_count() - 1;
    };
    for (const Triangle& t : torus.faces) {
        const std::uint32_t a = add(torus.positions[t[0]]);
        const std::uint32_t b = add(torus.positions[t[1]]);
        const std::uint32_t c = add(torus.positions[t[2]]);
        if (random.uniform(0, 1) < 0.5) {
            cracked.faces.push_back({a, b, c});
            continue;
        }
        const double at = 0.2 + 0.6 * random.uniform(0, 1);
        const std::uint32_t m = add(torus.positions[t[0]] * (1 - at) + torus.positions[t[1]] * at);
        cracked.faces.push_back({a, m, c});
        cracked.faces.push_back({m, b, c});
    }
    return cracked;
}

TEST(RepairMeshTest, CracksAndTJunctionsAreStitched) {
    for (const double noise : {0.0, 1e-9, 1e-5, 1e-3}) {
        for (std::uint64_t seed = 1; seed <= 5; ++seed) {
            const TriangleMesh cracked = cracked_torus(noise, seed);
            const RepairedMesh whole = repaired(cracked, kFull);
            const MeshReport report = inspect(whole.mesh);
            EXPECT_TRUE(report.closed) << "noise " << noise << ", seed " << seed;
            EXPECT_EQ(report.components, 1U);
            EXPECT_EQ(report.genus, 1);
            EXPECT_GT(count(whole.findings, Kind::kStitchedVertex) + count(whole.findings, Kind::kMergedVertex), 100U);
            const Expected<Deviation> deviation = measure_deviation(whole.mesh, cracked, {}, ExecutionContext());
            ASSERT_TRUE(deviation);
            EXPECT_LT(deviation->max(), 2e-3 * inspect(cracked).box.diagonal() + 1e-9);
        }
    }
}

TEST(RepairMeshTest, EveryBrokenSoupBecomesAManifold) {
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        test::Random random(seed);
        TriangleMesh soup;
        const auto vertices = static_cast<std::uint32_t>(5 + random.below(12));
        for (std::uint32_t v = 0; v < vertices; ++v)
            soup.positions.emplace_back(random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1));
        for (int f = 0; f < 40; ++f) {
            soup.faces.push_back({static_cast<std::uint32_t>(random.below(vertices)),
                                  static_cast<std::uint32_t>(random.below(vertices)),
                                  static_cast<std::uint32_t>(random.below(vertices))});
        }
        for (const RepairOptions& options : {kSafe, kFull, RepairOptions{RepairMode::kFull, 0.1, 0.2, 1, 0.1}}) {
            const Expected<RepairedMesh> result = repair_mesh(soup, options);
            ASSERT_TRUE(result);
            if (result->mesh.faces.empty()) continue;
            const Status manifold = require_manifold(inspect(result->mesh));
            EXPECT_TRUE(manifold) << "seed " << seed << ": " << manifold.error().message;
        }
    }
}

TEST(RepairMeshTest, StopsWhereverItIsCancelled) {
    const TriangleMesh mesh = test::joined(test::cube(), test::cube(), Vec3(1.001, 0, 0));  // FULL stitches them
    const RepairedMesh whole = repaired(mesh, kFull);
    std::size_t stops = 0;
    for (bool done = false; !done; ++stops) {
        ASSERT_LT(stops, 1000U) << "it is asked again and again";
        std::atomic<std::size_t> asked = 0;
        ExecutionContext context;
        context.cancel_when([&] { return asked++ >= stops; });
        const Expected<RepairedMesh> result = repair_mesh(mesh, kFull, context);
        done = result.has_value();
        if (done) {
            EXPECT_EQ(result->mesh, whole.mesh);
        } else {
            EXPECT_EQ(result.error().cause, Cause::kCancelled);
        }
    }
    EXPECT_GT(stops, 5U);
}

TEST(RepairMeshTest, OptionsOutOfRangeAreRefused) {
    const auto field = [](const RepairOptions& options) { return repair_mesh(test::cube(), options).error().field; };
    EXPECT_EQ(field({.weld = -1}), "weld");
    EXPECT_EQ(field({.mode = RepairMode::kFull, .stitch = -1}), "stitch");
    EXPECT_EQ(field({.mode = RepairMode::kSafe, .hole_size = 1}), "hole_size") << "SAFE fills none";
    EXPECT_EQ(field({.stitch = std::numeric_limits<double>::quiet_NaN()}), "stitch");
    EXPECT_EQ(field({.hole_size = std::numeric_limits<double>::infinity()}), "hole_size");
    EXPECT_EQ(field({.speck_size = -0.5}), "speck_size");
}

/// What the collection of dirty files holds, where it is on this machine.
TEST(RepairMeshTest, DirtyFilesBecomeManifolds) {
    struct Dirty {
        const char* name;
        bool closes;
    };
    for (const auto& [name, closes] :
         {Dirty{"open_featuretype.stl", true}, Dirty{"open_unitree_rubber_hand_70k.stl", true},
          Dirty{"dirty_openscad_nonmanifold_crash.obj", true}, Dirty{"combined_cycloidal_drive.ply", true},
          Dirty{"dirty_unitree_r1_head_cracked.stl", false}}) {
        const std::filesystem::path path = std::filesystem::path(VSPLIT_SHARED_MESHES) / name;
        if (!std::filesystem::exists(path)) GTEST_SKIP() << "no " << path;
        const Expected<ReadResult> read = read_mesh_file(path, {});
        ASSERT_TRUE(read);
        const RepairedMesh mended = repaired(read->mesh, kFull);
        EXPECT_EQ(count(mended.findings, Kind::kDegenerateFace), 0U) << name;
        const MeshReport report = inspect(mended.mesh);
        EXPECT_TRUE(require_manifold(report)) << name;
        EXPECT_EQ(report.closed, closes) << name << ": " << report.boundary_edges;
        EXPECT_LT(report.components, 113U) << name;
    }
}

}  // namespace
}  // namespace vsplit
