#include "cli/arguments.h"

#include <gtest/gtest.h>

#include <initializer_list>
#include <vector>

namespace vsplit::cli {
namespace {

std::variant<Arguments, int> parsed(std::initializer_list<const char*> words) {
    std::vector<const char*> argv{"vsplit"};
    argv.insert(argv.end(), words);
    return parse(static_cast<int>(argv.size()), argv.data());
}

Arguments arguments(std::initializer_list<const char*> words) {
    const auto result = parsed(words);
    EXPECT_TRUE(std::holds_alternative<Arguments>(result));
    return std::holds_alternative<Arguments>(result) ? std::get<Arguments>(result) : Arguments();
}

TEST(ArgumentsTest, ReadsImproveWhole) {
    const Arguments a = arguments({"improve",
                                   "part.stl",
                                   "-o",
                                   "a.vsplit",
                                   "-o",
                                   "b.stl",
                                   "--subdivide",
                                   "8",
                                   "--tolerance",
                                   "1e-3",
                                   "--faces",
                                   "30000",
                                   "--faces-min",
                                   "100",
                                   "--feature-angle",
                                   "30",
                                   "--feature-weight",
                                   "5",
                                   "--mode",
                                   "strict",
                                   "--weld",
                                   "0.5",
                                   "--repair",
                                   "none",
                                   "--threads",
                                   "2",
                                   "--json",
                                   "--no-progress",
                                   "--max-deviation",
                                   "2"});
    EXPECT_EQ(a.verb, Verb::kImprove);
    EXPECT_EQ(a.input, "part.stl");
    EXPECT_EQ(a.outputs, (std::vector<std::string>{"a.vsplit", "b.stl"}));
    EXPECT_EQ(a.improve.subdivision_size, 8.0);
    EXPECT_EQ(a.improve.tolerance, 1e-3);
    EXPECT_EQ(a.improve.faces, 30000U);
    EXPECT_EQ(asked_faces(a), 30000U);
    EXPECT_EQ(a.improve.faces_min, 100U);
    EXPECT_EQ(a.improve.feature_angle, 30.0);
    EXPECT_EQ(a.improve.feature_weight, 5.0);
    EXPECT_EQ(a.improve.max_deviation, 2.0);
    EXPECT_EQ(a.improve.mode, Mode::kStrict);
    EXPECT_EQ(a.weld, 0.5);
    EXPECT_EQ(a.repair, v1::NONE);
    EXPECT_EQ(a.threads, 2U);
    EXPECT_TRUE(a.json);
    EXPECT_TRUE(a.no_progress);
}

TEST(ArgumentsTest, ReadsControlWhole) {
    const Arguments a =
        arguments({"control",        "-",   "--subdivisions", "2",        "--min-stretch", "0.25", "--max-size",       "4",
                   "--max-valence",  "9",   "--server",       "h:1",      "--session",     "s",    "--representation", "r",
                   "--source-faces", "500", "--mode",         "extended", "--repair",      "full"});
    EXPECT_EQ(a.verb, Verb::kControl);
    EXPECT_EQ(a.control.subdivisions, 2U);
    EXPECT_EQ(a.control.min_stretch, 0.25);
    EXPECT_EQ(a.control.max_size, 4.0);
    EXPECT_EQ(a.control.max_valence, 9U);
    EXPECT_EQ(a.control.mode, Mode::kExtended);
    EXPECT_EQ(a.repair, v1::FULL);
    EXPECT_EQ(a.server, "h:1");
    EXPECT_EQ(a.session, "s");
    EXPECT_EQ(a.representation, "r");
    EXPECT_EQ(a.source_faces, 500U);
    EXPECT_FALSE(a.control.faces);
}

TEST(ArgumentsTest, ReadsTheBoundsOfControl) {
    const Arguments a = arguments(
        {"control", "a.stl", "--min-angle", "20", "--max-angle", "130.5", "--max-aspect-ratio", "3", "--min-size", "0.25"});
    EXPECT_EQ(a.control.min_angle, 20.0);
    EXPECT_EQ(a.control.max_angle, 130.5);
    EXPECT_EQ(a.control.max_aspect_ratio, 3.0);
    EXPECT_EQ(a.control.min_size, 0.25);
    EXPECT_FALSE(a.control.sizing);
    const Arguments sized = arguments({"control", "a.stl", "--min-size", "0.25", "--chord-error", "0.01"});
    EXPECT_EQ(sized.control.min_size, 0.25);
    ASSERT_TRUE(sized.control.sizing);
    EXPECT_EQ(sized.control.sizing->min_size, 0.25) << "nothing asks for less than may be";
}

TEST(ArgumentsTest, ReadsFeatureDetectionAndSizes) {
    const Arguments a = arguments(
        {"improve",     "a.stl",         "--feature-detection", "normal-voting", "--size-sphere",    "1,2,3,4,0.5",   "-o",
         "b.stl",       "--size-sphere", "-1e3,0,0,0,2",        "--size-box",    "0,0,0,1,2,3,0.25", "--chord-error", "0.01",
         "--gradation", "0.5",           "--min-size",          "0.1",           "--size-field",     "sizes.txt"});
    EXPECT_EQ(a.improve.feature_detection, FeatureDetection::kNormalVoting);
    ASSERT_TRUE(a.improve.sizing);
    const SizingOptions& sizing = *a.improve.sizing;
    ASSERT_EQ(sizing.spheres.size(), 2U);
    EXPECT_EQ(sizing.spheres[0].center, Vec3(1, 2, 3));
    EXPECT_EQ(sizing.spheres[0].radius, 4);
    EXPECT_EQ(sizing.spheres[0].size, 0.5);
    EXPECT_EQ(sizing.spheres[1].center, Vec3(-1000, 0, 0));
    ASSERT_EQ(sizing.boxes.size(), 1U);
    EXPECT_EQ(sizing.boxes[0].max, Vec3(1, 2, 3));
    EXPECT_EQ(sizing.boxes[0].size, 0.25);
    EXPECT_EQ(sizing.chord_error, 0.01);
    EXPECT_EQ(sizing.gradation, 0.5);
    EXPECT_EQ(sizing.min_size, 0.1);
    EXPECT_EQ(a.size_field, "sizes.txt");
    EXPECT_FALSE(arguments({"control", "a.stl", "--feature-detection", "dihedral"}).control.sizing);
    EXPECT_EQ(arguments({"control", "a.stl", "--chord-error", "2"}).control.sizing->gradation, kDefaultGradation);
}

TEST(ArgumentsTest, ReadsFreezeBoundary) {
    EXPECT_EQ(arguments({"improve", "a.stl", "--freeze-boundary"}).improve.freeze_boundary, true);
    EXPECT_EQ(arguments({"control", "a.stl", "--freeze-boundary"}).control.freeze_boundary, true);
    EXPECT_FALSE(arguments({"improve", "a.stl"}).improve.freeze_boundary);
}

TEST(ArgumentsTest, RefusesShapesThatAreNone) {
    testing::internal::CaptureStderr();
    EXPECT_EQ(std::get<int>(parsed({"improve", "a.stl", "--size-sphere", "1,2,3,4"})), 1);
    EXPECT_EQ(std::get<int>(parsed({"improve", "a.stl", "--size-sphere", "1,2,3,4,much"})), 1);
    EXPECT_EQ(std::get<int>(parsed({"improve", "a.stl", "--size-box", "1,2,3,4,5,6,7,8"})), 1);
    EXPECT_EQ(std::get<int>(parsed({"improve", "a.stl", "--feature-detection", "magic"})), 1);
    const std::string said = testing::internal::GetCapturedStderr();
    EXPECT_NE(said.find("'1,2,3,4' is given; accepted is X,Y,Z,RADIUS,SIZE, 5 numbers"), std::string::npos) << said;
    EXPECT_NE(said.find("accepted is one of dihedral, normal-voting"), std::string::npos) << said;
}

TEST(ArgumentsTest, NegativeNumbersReachTheEnginesOwnCheck) {
    EXPECT_EQ(arguments({"improve", "a.stl", "--tolerance", "-1"}).improve.tolerance, -1.0);
    EXPECT_EQ(arguments({"info", "a.stl", "--weld=-1"}).weld, -1.0);
}

TEST(ArgumentsTest, RefusesWithStatusOne) {
    testing::internal::CaptureStderr();
    EXPECT_EQ(std::get<int>(parsed({})), 1);
    EXPECT_EQ(std::get<int>(parsed({"destroy", "a.stl"})), 1);
    EXPECT_EQ(std::get<int>(parsed({"info", "a.stl", "b.stl"})), 1);
    EXPECT_EQ(std::get<int>(parsed({"info", "a.stl", "--tolerance", "1"})), 1);
    EXPECT_EQ(std::get<int>(parsed({"improve", "a.stl", "--tolerance", "much"})), 1);
    EXPECT_EQ(std::get<int>(parsed({"improve", "a.stl", "--faces", "-5"})), 1);
    EXPECT_EQ(std::get<int>(parsed({"improve", "a.stl", "--faces", "99999999999"})), 1);
    EXPECT_EQ(std::get<int>(parsed({"improve", "a.stl", "--mode", "loose"})), 1);
    EXPECT_EQ(std::get<int>(parsed({"improve", "a.stl", "--threads", "1025"})), 1);
    EXPECT_EQ(std::get<int>(parsed({"improve", "a.stl", "-o"})), 1);
    const std::string said = testing::internal::GetCapturedStderr();
    EXPECT_NE(said.find("accepted is one of control, features, improve, info, quality, remove-features, resolution"),
              std::string::npos)
        << said;
    EXPECT_NE(said.find("--mode: 'loose' is given; accepted is one of extended, strict"), std::string::npos) << said;
    EXPECT_NE(said.find("--faces: '-5' is given; accepted is a whole number"), std::string::npos) << said;
}

TEST(ArgumentsTest, TellsRepresentationFilesByTheirName) {
    EXPECT_TRUE(is_representation_file("a.vsplit"));
    EXPECT_TRUE(is_representation_file("dir/A.VSPLIT"));
    EXPECT_FALSE(is_representation_file("a.stl"));
    EXPECT_FALSE(is_representation_file("vsplit"));
    EXPECT_FALSE(is_representation_file(""));
}

}  // namespace
}  // namespace vsplit::cli
