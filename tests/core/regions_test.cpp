// Regions and sets all the way: files, weld, repair, subdivision, both methods at every resolution, stored representations.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <string>

#include "spatial/surface_index.h"
#include "tests/core/meshes.h"
#include "vsplit/io/read_mesh.h"
#include "vsplit/io/write_mesh.h"
#include "vsplit/mesh/weld.h"
#include "vsplit/method/control.h"
#include "vsplit/method/improve.h"
#include "vsplit/mrr/mrr_file.h"
#include "vsplit/mrr/progressive_mesh.h"
#include "vsplit/repair/repair_mesh.h"
#include "vsplit/subdivide/subdivide.h"

namespace vsplit::test {
namespace {

Vec3 middle(const TriangleMesh& mesh, std::uint32_t f) {
    const Triangle& t = mesh.faces[f];
    return (mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]) / 3;
}

/// Three bands around the z axis: borders across flat and round surfaces, where nothing else is a crease.
TriangleMesh banded(TriangleMesh mesh) {
    const BoundingBox box = bounding_box(mesh);
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        const double at = (middle(mesh, f).x() - box.min.x()) / (box.max.x() - box.min.x());
        mesh.regions.push_back(at < 0.3 ? 4 : at < 0.7 ? 7 : 9);
    }
    mesh.sets = {{"left", {4}}, {"right", {9}}, {"ends", {4, 9}}};
    return mesh;
}

TriangleMesh part_of(const TriangleMesh& mesh, std::uint32_t region) {
    TriangleMesh part{mesh.positions, {}};
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        if (mesh.regions[f] == region) part.faces.push_back(mesh.faces[f]);
    }
    return part;
}

/// Every face lies where the source has its region, and every region is as large as it was.
void expect_regions_of(const TriangleMesh& result, const TriangleMesh& source, double distance, const std::string& what) {
    ASSERT_EQ(result.regions.size(), result.faces.size()) << what;
    EXPECT_EQ(result.sets, source.sets);
    for (const std::uint32_t region : {4U, 7U, 9U}) {
        const TriangleMesh of_source = part_of(source, region);
        const TriangleMesh of_result = part_of(result, region);
        const SurfaceIndex index = surface_index(of_source);
        for (std::uint32_t f = 0; f < of_result.face_count(); ++f)
            EXPECT_TRUE(index.within(middle(of_result, f), distance)) << what << ", region " << region << ", face " << f;
        EXPECT_NEAR(surface_area(of_result), surface_area(of_source), 0.05 * surface_area(source)) << what;
    }
}

class RegionsTest : public testing::TestWithParam<bool> {
protected:
    const TriangleMesh source_ = banded(GetParam() ? open_cylinder(40, 20) : torus(60, 24));
    const double tolerance_ = 0.002 * bounding_box(source_).diagonal();
};

TEST_P(RegionsTest, AreKeptByImproveAndControlAtEveryResolution) {
    ImproveOptions options;
    options.tolerance = tolerance_;
    options.faces = 1200;
    const Expected<MethodResult> improved = improve(source_, options, {}, ExecutionContext());
    ASSERT_TRUE(improved) << improved.error().message;
    for (const std::size_t level : {std::size_t{0}, improved->mrr.levels() / 2, improved->mrr.levels()}) {
        expect_regions_of(mesh_at(improved->mrr, level), source_, 2 * tolerance_ + 1e-9, "improve at " + std::to_string(level));
    }
    const TriangleMesh shown = mesh_at(improved->mrr, improved->mrr.level_for(improved->faces));
    ControlOptions bounds;
    bounds.tolerance = tolerance_;
    const Expected<MethodResult> controlled = control(shown, bounds, {}, ExecutionContext());
    ASSERT_TRUE(controlled) << controlled.error().message;
    expect_regions_of(mesh_at(controlled->mrr, controlled->mrr.level_for(controlled->faces)), source_, 4 * tolerance_, "control");
}

TEST_P(RegionsTest, AreStoredInRepresentations) {
    ImproveOptions options;
    options.faces = 600;
    Expected<MethodResult> improved = improve(source_, options, {}, ExecutionContext());
    ASSERT_TRUE(improved);
    const StoredMrr stored{improved->mrr, improved->faces, "{}"};
    const std::string bytes = encode_mrr(stored);
    const Expected<StoredMrr> again = decode_mrr(std::as_bytes(std::span(bytes)));
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(again->mrr, improved->mrr);
    const std::size_t section = bytes.rfind("REGN");
    ASSERT_NE(section, std::string::npos);
    for (std::size_t at = section; at < bytes.size(); ++at) {
        std::string bad = bytes;
        bad[at] = static_cast<char>(bad[at] ^ 1);
        EXPECT_FALSE(decode_mrr(std::as_bytes(std::span(bad)))) << at;
    }
    for (std::size_t size = section + 1; size < bytes.size(); ++size)
        EXPECT_FALSE(decode_mrr(std::as_bytes(std::span(bytes).first(size)))) << size;
}

INSTANTIATE_TEST_SUITE_P(Both, RegionsTest, testing::Bool(), [](const auto& param) { return param.param ? "Open" : "Closed"; });

TEST(RegionsOfMeshesTest, AreKeptByWeldSubdivisionAndRepair) {
    TriangleMesh mesh = banded(torus(30, 12));
    const TriangleMesh good = mesh;
    mesh.faces.insert(mesh.faces.begin() + 5, {3, 3, 4});
    mesh.regions.insert(mesh.regions.begin() + 5, 99);
    ASSERT_TRUE(weld(mesh, 0));
    EXPECT_EQ(mesh, good);
    const Expected<SubdividedMesh> fine = subdivide_to_size(good, 0.1, 1'000'000, ExecutionContext());
    ASSERT_TRUE(fine);
    expect_regions_of(fine->mesh, good, 1e-12, "subdivision");

    TriangleMesh broken = good;
    std::swap(broken.faces[8][0], broken.faces[8][1]);
    broken.faces.erase(broken.faces.begin() + 100);
    broken.regions.erase(broken.regions.begin() + 100);
    broken.faces.push_back(broken.faces[40]);
    broken.regions.push_back(broken.regions[40]);
    const Expected<RepairedMesh> repaired = repair_mesh(broken, {.mode = RepairMode::kFull, .hole_size = 1});
    ASSERT_TRUE(repaired);
    EXPECT_TRUE(inspect(repaired->mesh).closed);
    expect_regions_of(repaired->mesh, good, 0.1, "repair");
}

TEST(RegionsOfMeshesTest, ComeBackFromPlyObjAndStl) {
    const auto read = [](const std::string& bytes) { return read_mesh(std::as_bytes(std::span(bytes)), {})->mesh; };
    const TriangleMesh mesh = banded(torus(30, 12));
    for (const MeshFormat format : {MeshFormat::kPlyBinary, MeshFormat::kPlyAscii}) {
        const TriangleMesh same = read(write_mesh(mesh, format));
        EXPECT_EQ(same.regions, mesh.regions);
        EXPECT_EQ(same.faces, mesh.faces);
    }
    EXPECT_EQ(read(write_mesh(mesh, MeshFormat::kStlBinary)).regions, mesh.regions);
    const TriangleMesh grouped = read(write_mesh(mesh, MeshFormat::kObj));
    // A group after the other, each with its faces in order.
    EXPECT_EQ(grouped.positions, mesh.positions);
    ASSERT_EQ(grouped.sets.size(), 3U);
    const auto faces_in = [](const TriangleMesh& of, std::uint32_t region) {
        std::vector<Triangle> faces;
        for (std::uint32_t f = 0; f < of.face_count(); ++f) {
            if (of.regions[f] == region) faces.push_back(of.faces[f]);
        }
        return faces;
    };
    for (const auto& [region, name] : std::map<std::uint32_t, std::string>{{4, "left"}, {9, "right"}, {7, "region_7"}}) {
        const auto is_it = [&n = name](const FaceSet& set) { return set.name == n; };
        const auto set = std::find_if(grouped.sets.begin(), grouped.sets.end(), is_it);
        ASSERT_NE(set, grouped.sets.end()) << name;
        EXPECT_EQ(faces_in(grouped, set->regions.at(0)), faces_in(mesh, region)) << name;
    }
    const TriangleMesh solids = read(write_mesh(mesh, MeshFormat::kStlAscii));
    ASSERT_EQ(solids.sets.size(), 3U);
    EXPECT_EQ(solids.sets[0].name, "left");
    EXPECT_NEAR(surface_area(part_of(solids, 1)), surface_area(part_of(mesh, 4)), 1e-5);
}

}  // namespace
}  // namespace vsplit::test
