#include "cli/report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "tests/core/meshes.h"
#include "vsplit/mesh/inspect.h"
#include "wire/convert.h"

namespace vsplit::cli {
namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(ReportTest, TellsWhatAMeshIs) {
    const std::string text = report(wire::to_proto(inspect(test::torus(40, 20))), false);
    EXPECT_TRUE(has(text, "faces             1,600\n")) << text;
    EXPECT_TRUE(has(text, "closed            yes\n")) << text;
    EXPECT_TRUE(has(text, "genus             1\n")) << text;
    EXPECT_FALSE(has(text, "worst face"));
}

TEST(ReportTest, ListsTheFirstGroups) {
    TriangleMesh mesh = test::cube();
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) mesh.regions.push_back(f / 4);
    mesh.sets = {{"inlet", {0, 1}}, {"wall", {0}}};
    const std::string text = report(wire::to_proto(inspect(mesh)), false);
    EXPECT_TRUE(has(text, "group             inlet: 8 faces, regions 0, 1\n")) << text;
    EXPECT_TRUE(has(text, "group             wall: 4 faces, region 0\n")) << text;
    EXPECT_TRUE(has(text, "group             region 2: 4 faces\n")) << text;
    EXPECT_FALSE(has(text, "in all")) << text;
    mesh = test::icosphere(2);
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) mesh.regions.push_back(f);
    const std::string many = report(wire::to_proto(inspect(mesh)), false);
    EXPECT_TRUE(has(many, "region 19: 1 face\n")) << many;
    EXPECT_FALSE(has(many, "region 20:")) << many;
    EXPECT_TRUE(has(many, "320 in all")) << many;
}

TEST(ReportTest, EveryLengthHasItsUnit) {
    const TriangleMesh mesh = test::sliver_cylinder(12, 10);
    MeshReport measured = inspect(mesh);
    EXPECT_TRUE(has(report(wire::to_proto(measured), false), "unit              not known\n"));
    measured.unit = LengthUnit::kInch;
    v1::MeshSummary summary = wire::to_proto(measured);
    *summary.mutable_quality() = wire::to_proto(measured.quality, worst_faces(mesh, 4));
    summary.mutable_quality()->set_deviation_max(0.5);
    const std::string text = report(summary, true);
    EXPECT_TRUE(has(text, "unit              in\n")) << text;
    EXPECT_TRUE(has(text, "deviation         0.5 in\n")) << text;
    EXPECT_TRUE(has(text, "    size, in  centroid, in\n")) << text;
    for (const std::string line : {"box", "longest edge"}) {
        const std::size_t at = text.find("\n" + line);
        ASSERT_NE(at, std::string::npos) << text;
        EXPECT_TRUE(text.substr(at + 1, text.find('\n', at + 1) - at - 1).ends_with(" in")) << text;
    }

    v1::Representation made;
    made.set_unit(v1::MILLIMETRE);
    made.mutable_control_options()->set_tolerance(0.1);
    made.mutable_control_options()->set_max_size(2);
    made.mutable_control_options()->set_min_size(1);
    v1::Violation& size = *made.add_violations();
    size.set_bound("max_size");
    size.set_worst(3);
    v1::Violation& valence = *made.add_violations();
    valence.set_bound("max_valence");
    valence.set_worst(9);
    const std::string told = report(made, false);
    for (const std::string line : {"tolerance         0.1 mm\n", "size bound        2 mm\n", "least size        1 mm\n",
                                   "max_size broken by 0 faces, worst 3 mm; max_valence broken by 0 vertices, worst 9\n"})
        EXPECT_TRUE(has(told, line)) << told;

    v1::ListFeaturesResponse features;
    features.set_unit(v1::METRE);
    features.add_features();
    EXPECT_TRUE(has(report(features, false), "diameter, m    depth, m   faces  centre, m; axis\n")) << report(features, false);
    Comparison comparison;
    comparison.unit = LengthUnit::kMicrometre;
    EXPECT_TRUE(has(report(comparison, false), "diagonal          0 um\n")) << report(comparison, false);
    EXPECT_TRUE(has(report(comparison, false), "to source         0 to 0 um\n")) << report(comparison, false);
}

TEST(ReportTest, TellsWhereThereAreNoCreasesToCompare) {
    Comparison comparison;
    comparison.creases.source_creases = 1;
    EXPECT_TRUE(has(report(comparison, true), "creases           none is kept\n"));
    comparison.creases.source_creases = 0;
    EXPECT_FALSE(has(report(comparison, true), "creases  "));
}

TEST(ReportTest, NamesWhatIsWrongWithAnOpenMesh) {
    TriangleMesh open = test::cube();
    open.faces.pop_back();
    const std::string text = report(wire::to_proto(inspect(open)), false);
    EXPECT_TRUE(has(text, "no, 3 boundary edges")) << text;
    EXPECT_TRUE(has(text, "finding           BOUNDARY_EDGE: ")) << text;
    EXPECT_FALSE(has(text, "genus"));
}

TEST(ReportTest, DetailsMarkTheFloorAndPlaceTheWorst) {
    const TriangleMesh mesh = test::sliver_cylinder(12, 10);
    v1::MeshSummary summary = wire::to_proto(inspect(mesh));
    *summary.mutable_quality() = wire::to_proto(measure_quality(mesh), worst_faces(mesh, 4));
    const std::string text = report(summary, true);
    std::istringstream lines(text);
    std::vector<std::string> all;
    for (std::string line; std::getline(lines, line);) all.push_back(line);
    const auto floor = std::find_if(all.begin(), all.end(), [](const std::string& l) { return has(l, "---- 0.2"); });
    ASSERT_NE(floor, all.end()) << text;
    EXPECT_TRUE(has(*(floor - 1), "0.15-0.20")) << text;
    EXPECT_TRUE(has(*(floor + 1), "0.20-0.25")) << text;
    const auto worst = std::find_if(all.begin(), all.end(), [](const std::string& l) { return has(l, "worst face"); });
    ASSERT_NE(worst, all.end()) << text;
    EXPECT_EQ(all.end() - worst, 5);
    EXPECT_TRUE(has(*(worst + 1), "("));
}

TEST(ReportTest, TellsWhatARepresentationIs) {
    v1::Representation made;
    made.set_id("r1");
    made.set_method(v1::CONTROL);
    made.set_faces(1000);
    made.set_faces_min(100);
    made.set_faces_max(4000);
    made.mutable_control_options()->set_min_stretch(0.2);
    made.mutable_control_options()->set_max_valence(10);
    made.mutable_elapsed()->set_seconds(2);
    made.set_bounds_satisfied(true);
    made.mutable_quality()->set_crease_deviation_max(0.25);
    made.add_slivers()->set_message("83 faces lie between creases 0.012 to 0.03 apart");
    made.add_slivers()->set_message("1 face joins corners");
    made.mutable_records()->set_splits(1000);
    made.mutable_records()->set_flips(2000);
    made.mutable_records()->set_moves(1);
    const std::string text = report(made, false);
    EXPECT_TRUE(has(text, "crease deviation  0.25\n")) << text;
    EXPECT_TRUE(has(text,
                    "slivers           83 faces lie between creases 0.012 to 0.03 apart\n"
                    "slivers           1 face joins corners\n"))
        << text;
    EXPECT_TRUE(has(text,
                    "records           1,000 splits, 2,000 flips, 1 move\n"
                    "bytes a split     67.0 (57 + 10.0 of flips + 0.0 of moves)\n"))
        << text;
    EXPECT_TRUE(has(text, "representation    r1\n")) << text;
    EXPECT_TRUE(has(text, "1,000 (100 to 4,000 at hand)")) << text;
    EXPECT_TRUE(has(text, "valence bound     10\n")) << text;
    EXPECT_FALSE(has(text, "size bound"));
    EXPECT_TRUE(has(text, "bounds            all hold\n")) << text;
    EXPECT_TRUE(has(text, "time              2.00 s\n")) << text;
}

}  // namespace
}  // namespace vsplit::cli
