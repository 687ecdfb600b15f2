#include "cli/message.h"

#include <gtest/gtest.h>

#include "cli/number_text.h"
#include "cli/progress_bar.h"

namespace vsplit::cli {
namespace {

TEST(MessageTest, AnErrorNamesCauseAndOption) {
    EXPECT_EQ(error_message({Cause::kInvalidOption, "subdivision_size is -1", "subdivision_size"}),
              "vsplit: INVALID_OPTION: subdivision_size is -1 (--subdivide)\n");
    EXPECT_EQ(error_message({Cause::kOpenMesh, "3 edges have one face", ""}),
              "vsplit: OPEN_MESH: 3 edges have one face (--weld T, --repair full)\n");
    EXPECT_EQ(error_message({Cause::kNonManifold, "2 edges have three faces", ""}),
              "vsplit: NON_MANIFOLD: 2 edges have three faces (--repair safe|full)\n");
    EXPECT_EQ(error_message({Cause::kNotFound, "none", "page_token"}), "vsplit: NOT_FOUND: none\n");
    EXPECT_EQ(error_message({Cause::kCancelled, "whatever", ""}), "vsplit: cancelled\n");
}

TEST(MessageTest, ABrokenBoundIsToldWithCountWorstAndReason) {
    v1::Representation made;
    EXPECT_EQ(violation_messages(made), "");
    v1::Violation& stretch = *made.add_violations();
    stretch.set_bound("min_stretch");
    stretch.set_limit(0.2);
    stretch.set_worst(0.125);
    stretch.set_count(1);
    stretch.set_reason("no collapse helps");
    v1::Violation& valence = *made.add_violations();
    valence.set_bound("max_valence");
    valence.set_limit(8);
    valence.set_worst(11);
    valence.set_count(1200);
    valence.set_reason("flips are not offered");
    for (const std::uint32_t v : {3, 5, 8, 13, 21, 34}) valence.add_elements(v);
    stretch.add_elements(7);
    EXPECT_EQ(violation_messages(made),
              "vsplit: bound not met: min_stretch 0.2: 1 face (7), worst 0.125; no collapse helps\n"
              "vsplit: bound not met: max_valence 8: 1,200 vertices (3, 5, 8, 13, 21, ...), worst 11; flips are not offered\n");
}

TEST(MessageTest, NothingRemovedSaysWhatIsLarger) {
    v1::ListFeaturesResponse features;
    features.set_unit(v1::MILLIMETRE);
    FeatureRemoval removal;
    EXPECT_EQ(nothing_removed_note(removal, features), "") << "ids were asked for";
    removal.max_diameter = 5;
    EXPECT_EQ(nothing_removed_note(removal, features),
              "vsplit: note: nothing is removed: no feature has a diameter of 5 mm or less; there are no larger ones either\n");
    for (const double diameter : {9.0, 6.5}) {
        v1::ShapeFeature& hole = *features.add_features();
        hole.set_kind(v1::ShapeFeature::BLIND_HOLE);
        hole.set_diameter(diameter);
    }
    removal.kinds = {ShapeFeature::Kind::kBoss, ShapeFeature::Kind::kBlindHole};
    EXPECT_EQ(
        nothing_removed_note(removal, features),
        "vsplit: note: nothing is removed: no feature of the kinds asked for has a diameter of 5 mm or less; 2 larger: from "
        "6.5 mm on\n");
    removal.kinds = {ShapeFeature::Kind::kBoss};
    EXPECT_NE(nothing_removed_note(removal, features).find("no larger"), std::string::npos);
}

TEST(MessageTest, TheNearestResolutionIsToldOnlyWhereItIsAnother) {
    v1::Representation made;
    made.set_faces(100);
    made.set_faces_min(100);
    made.set_faces_max(5000);
    EXPECT_EQ(nearest_note(100, made), "");
    EXPECT_EQ(nearest_note(101, made), "");  // counts go in steps of two
    EXPECT_NE(nearest_note(50, made).find("100 is the nearest"), std::string::npos);
    EXPECT_NE(nearest_note(110, made).find("that keeps the bounds"), std::string::npos);
    made.set_faces(5000);
    EXPECT_NE(nearest_note(9000, made).find("there are 100 to 5,000"), std::string::npos);
}

TEST(NumberTextTest, Formats) {
    EXPECT_EQ(grouped(0), "0");
    EXPECT_EQ(grouped(999), "999");
    EXPECT_EQ(grouped(1000), "1,000");
    EXPECT_EQ(grouped(1234567), "1,234,567");
    EXPECT_EQ(figure(0.0125), "0.0125");
    EXPECT_EQ(fixed(0.68049, 3), "0.680");
    EXPECT_EQ(fixed(1e300, 2).size(), 304U);
    EXPECT_EQ(left("ab", 4), "ab  ");
    EXPECT_EQ(right("ab", 4), "  ab");
    EXPECT_EQ(right("abcdef", 4), "abcdef");
}

TEST(ProgressBarTest, LineSaysStageShareAndDetail) {
    EXPECT_EQ(progress_line("simplify", 0.5, "12 faces"), "[############            ]  50 %  simplify  12 faces");
    EXPECT_EQ(progress_line("upload", 7, ""), "[########################] 100 %  upload");
    EXPECT_EQ(progress_line("upload", -1, ""), "[                        ]   0 %  upload");
}

}  // namespace
}  // namespace vsplit::cli
