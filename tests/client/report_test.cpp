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
