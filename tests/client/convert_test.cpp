#include "wire/convert.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "tests/core/meshes.h"
#include "vsplit/mrr/record_block.h"

namespace vsplit::wire {
namespace {

TEST(ConvertTest, SummaryHoldsTheReport) {
    const TriangleMesh mesh = test::torus(12, 8);
    const MeshReport report = inspect(mesh);
    const v1::MeshSummary summary = to_proto(report);
    EXPECT_EQ(summary.vertices(), 96U);
    EXPECT_EQ(summary.faces(), 192U);
    EXPECT_TRUE(summary.closed());
    EXPECT_EQ(summary.components(), 1U);
    EXPECT_EQ(summary.genus(), 1);
    EXPECT_DOUBLE_EQ(summary.bounding_box().max().x(), report.box.max.x());
    EXPECT_DOUBLE_EQ(summary.bounding_box().min().z(), report.box.min.z());
    EXPECT_EQ(summary.quality().faces(), 192U);
    EXPECT_DOUBLE_EQ(summary.quality().stretch_mean(), report.quality.stretch_mean);
    EXPECT_EQ(summary.quality().stretch_histogram_size(), 20);
    EXPECT_FALSE(summary.quality().has_deviation_max());
}

TEST(ConvertTest, FindingsKeepNamePlaceAndCount) {
    TriangleMesh open = test::cube();
    open.faces.pop_back();
    const v1::MeshSummary summary = to_proto(inspect(open));
    EXPECT_FALSE(summary.closed());
    EXPECT_EQ(summary.boundary_edges(), 3U);
    ASSERT_EQ(summary.findings_size(), 1);
    EXPECT_EQ(summary.findings(0).kind(), "BOUNDARY_EDGE");
    EXPECT_EQ(summary.findings(0).count(), 3U);
    EXPECT_EQ(summary.findings(0).elements_size(), 6);
}

TEST(ConvertTest, QualityListsTheWorstFaces) {
    const TriangleMesh mesh = test::sliver_cylinder(16, 10);
    const std::vector<FaceQuality> worst = worst_faces(mesh, 3);
    const v1::Quality quality = to_proto(measure_quality(mesh), worst);
    ASSERT_EQ(quality.worst_faces_size(), 3);
    EXPECT_EQ(quality.worst_faces(0).face(), worst[0].face);
    EXPECT_DOUBLE_EQ(quality.worst_faces(0).stretch(), quality.stretch_min());
    EXPECT_DOUBLE_EQ(quality.worst_faces(2).centroid().y(), worst[2].centroid.y());
}

TEST(ConvertTest, AnEmptyBoxHasNoCorners) {
    EXPECT_FALSE(to_proto(BoundingBox()).has_min());
    EXPECT_FALSE(to_proto(BoundingBox()).has_max());
}

ImproveOptions full_improve_options() {
    ImproveOptions options;
    options.subdivision_size = 8;
    options.tolerance = 1.5;
    options.max_deviation = 2.5;
    options.feature_angle = 30;
    options.feature_weight = 7;
    options.faces = 1000;
    options.faces_min = 10;
    options.mode = Mode::kExtended;
    options.feature_detection = FeatureDetection::kNormalVoting;
    options.marked_edges = {0, 1, 4, 2};
    options.regions = {7, 7, 4294967295U};
    SizingOptions& sizing = options.sizing.emplace();
    sizing.spheres = {{{1, 2, 3}, 4, 5}, {{-1, -2, -3}, 0, 0.5}};
    sizing.boxes = {{{0, 1, 2}, {3, 4, 5}, 6}};
    sizing.chord_error = 0.25;
    sizing.field = {0, 1.5, 1e-9};
    sizing.gradation = 0.75;
    sizing.min_size = 0.125;
    sizing.max_size = 100;
    options.freeze_boundary = true;
    return options;
}

void expect_same(const SizingOptions& back, const SizingOptions& sent) {
    ASSERT_EQ(back.spheres.size(), sent.spheres.size());
    for (std::size_t i = 0; i < sent.spheres.size(); ++i) {
        EXPECT_EQ(back.spheres[i].center, sent.spheres[i].center);
        EXPECT_EQ(back.spheres[i].radius, sent.spheres[i].radius);
        EXPECT_EQ(back.spheres[i].size, sent.spheres[i].size);
    }
    ASSERT_EQ(back.boxes.size(), sent.boxes.size());
    for (std::size_t i = 0; i < sent.boxes.size(); ++i) {
        EXPECT_EQ(back.boxes[i].min, sent.boxes[i].min);
        EXPECT_EQ(back.boxes[i].max, sent.boxes[i].max);
        EXPECT_EQ(back.boxes[i].size, sent.boxes[i].size);
    }
    EXPECT_EQ(back.chord_error, sent.chord_error);
    EXPECT_EQ(back.field, sent.field);
    EXPECT_EQ(back.gradation, sent.gradation);
    EXPECT_EQ(back.min_size, sent.min_size);
    EXPECT_EQ(back.max_size, sent.max_size);
}

TEST(ConvertTest, ImproveOptionsSurviveTheWay) {
    const ImproveOptions options = full_improve_options();
    const Expected<ImproveOptions> back = from_proto(to_proto(options));
    ASSERT_TRUE(back);
    EXPECT_EQ(back->subdivision_size, options.subdivision_size);
    EXPECT_EQ(back->tolerance, options.tolerance);
    EXPECT_EQ(back->max_deviation, options.max_deviation);
    EXPECT_EQ(back->feature_angle, options.feature_angle);
    EXPECT_EQ(back->feature_weight, options.feature_weight);
    EXPECT_EQ(back->faces, options.faces);
    EXPECT_EQ(back->faces_min, options.faces_min);
    EXPECT_EQ(back->mode, options.mode);
    EXPECT_EQ(back->feature_detection, options.feature_detection);
    EXPECT_EQ(back->marked_edges, options.marked_edges);
    EXPECT_EQ(back->regions, options.regions);
    EXPECT_EQ(back->freeze_boundary, options.freeze_boundary);
    ASSERT_TRUE(back->sizing);
    expect_same(*back->sizing, *options.sizing);
}

TEST(ConvertTest, ControlOptionsSurviveTheWay) {
    ControlOptions options;
    options.subdivisions = 0;
    options.min_stretch = 0.3;
    options.max_size = 4;
    options.max_valence = 9;
    options.min_angle = 20;
    options.max_angle = 130;
    options.max_aspect_ratio = 3;
    options.min_size = 0.25;
    options.tolerance = 0.5;
    options.mode = Mode::kStrict;
    options.feature_detection = FeatureDetection::kDihedral;
    options.regions = {1, 2};
    options.sizing.emplace().chord_error = 0.5;
    options.freeze_boundary = false;
    const Expected<ControlOptions> back = from_proto(to_proto(options));
    ASSERT_TRUE(back);
    EXPECT_EQ(back->subdivisions, options.subdivisions);
    EXPECT_EQ(back->min_stretch, options.min_stretch);
    EXPECT_EQ(back->max_size, options.max_size);
    EXPECT_EQ(back->max_valence, options.max_valence);
    EXPECT_EQ(back->min_angle, options.min_angle);
    EXPECT_EQ(back->max_angle, options.max_angle);
    EXPECT_EQ(back->max_aspect_ratio, options.max_aspect_ratio);
    EXPECT_EQ(back->min_size, options.min_size);
    EXPECT_EQ(back->tolerance, options.tolerance);
    EXPECT_EQ(back->mode, options.mode);
    EXPECT_EQ(back->feature_detection, options.feature_detection);
    EXPECT_EQ(back->regions, options.regions);
    EXPECT_TRUE(back->marked_edges.empty());
    EXPECT_EQ(back->freeze_boundary, false);
    ASSERT_TRUE(back->sizing);
    expect_same(*back->sizing, *options.sizing);
    EXPECT_FALSE(back->faces || back->faces_min || back->max_deviation || back->feature_angle || back->feature_weight);
}

TEST(ConvertTest, AbsentOptionsStayAbsentAndZeroDoesNot) {
    const Expected<ImproveOptions> empty = from_proto(v1::ImproveOptions());
    ASSERT_TRUE(empty);
    EXPECT_FALSE(empty->subdivision_size || empty->tolerance || empty->faces || empty->mode);
    EXPECT_FALSE(empty->feature_detection || empty->sizing || empty->freeze_boundary);
    EXPECT_TRUE(empty->marked_edges.empty() && empty->regions.empty());
    v1::ImproveOptions bare;
    bare.mutable_sizing();
    ASSERT_TRUE(from_proto(bare)->sizing);
    EXPECT_EQ(from_proto(bare)->sizing->gradation, kDefaultGradation);
    v1::ImproveOptions zero;
    zero.set_tolerance(0);
    EXPECT_EQ(from_proto(zero)->tolerance, 0.0);  // for check_options to refuse
}

TEST(ConvertTest, UnknownEnumNumbersAreNamedErrors) {
    v1::ImproveOptions improve;
    improve.set_mode(static_cast<v1::Mode>(7));
    EXPECT_EQ(from_proto(improve).error().field, "mode");
    v1::ControlOptions control;
    control.set_mode(static_cast<v1::Mode>(7));
    EXPECT_EQ(from_proto(control).error().cause, Cause::kInvalidOption);
    control.clear_mode();
    control.set_feature_detection(static_cast<v1::FeatureDetection>(9));
    EXPECT_EQ(from_proto(control).error().field, "feature_detection");
    EXPECT_EQ(from_proto(static_cast<v1::MeshFormat>(99)).error().field, "format");
    EXPECT_EQ(from_proto(static_cast<v1::RecordEncoding>(99)).error().field, "encoding");
    EXPECT_EQ(from_proto(static_cast<v1::Repair>(99)).error().cause, Cause::kInvalidOption);
    EXPECT_EQ(from_proto(static_cast<v1::LengthUnit>(99)).error().field, "unit");
}

TEST(ConvertTest, FormatsSurviveTheWay) {
    for (const MeshFormat format : mesh_formats()) {
        EXPECT_NE(to_proto(std::optional(format)), v1::MESH_FORMAT_UNSPECIFIED);
        EXPECT_EQ(*from_proto(to_proto(std::optional(format))), format);
    }
    EXPECT_EQ(to_proto(std::optional<MeshFormat>()), v1::MESH_FORMAT_UNSPECIFIED);
    EXPECT_EQ(*from_proto(v1::MESH_FORMAT_UNSPECIFIED), std::nullopt);
}

TEST(ConvertTest, UnitsSurviveTheWay) {
    for (const LengthUnit unit : length_units()) {
        EXPECT_NE(to_proto(std::optional(unit)), v1::LENGTH_UNIT_UNSPECIFIED);
        EXPECT_EQ(*from_proto(to_proto(std::optional(unit))), unit);
    }
    EXPECT_EQ(to_proto(std::optional<LengthUnit>()), v1::LENGTH_UNIT_UNSPECIFIED);
    EXPECT_EQ(*from_proto(v1::LENGTH_UNIT_UNSPECIFIED), std::nullopt);
}

TEST(ConvertTest, RepairsAreTold) {
    EXPECT_EQ(*from_proto(v1::REPAIR_UNSPECIFIED), std::nullopt);
    EXPECT_EQ(*from_proto(v1::NONE), RepairMode::kNone);
    EXPECT_EQ(*from_proto(v1::SAFE), RepairMode::kSafe);
    EXPECT_EQ(*from_proto(v1::FULL), RepairMode::kFull);
}

TEST(ConvertTest, OfAFindingTheFirstPlacesAreSent) {
    Finding finding{Finding::Kind::kStitchedVertex, 100, "many", {7}, std::vector<Vec3>(100, Vec3(1, 2, 3))};
    const v1::Finding proto = to_proto(finding);
    EXPECT_EQ(proto.kind(), "STITCHED_VERTEX");
    EXPECT_EQ(proto.places_size(), static_cast<int>(Finding::kExamples));
    EXPECT_EQ(proto.places(0).z(), 3);
}

TEST(ConvertTest, RecordBlocksSurviveTheWay) {
    const RecordList records{VertexSplit{1, 2, {0, 1, 2}, {3, 4, 5}}, EdgeFlip{8}, VertexMove{6, {0.1, 0.2, 0.3}}};
    const RecordBlock block = encode_block(records, 41, RecordEncoding::kFloat64);
    const v1::RecordBlock message = to_proto(block);
    EXPECT_EQ(message.first(), 41U);
    EXPECT_EQ(message.count(), 3U);
    const Expected<RecordBlock> back = from_proto(message);
    ASSERT_TRUE(back);
    const Expected<RecordList> decoded = decode_block(*back);
    ASSERT_TRUE(decoded);
    EXPECT_EQ(*decoded, records);
}

TEST(ConvertTest, BlocksOfUnknownEncodingAreCorrupt) {
    v1::RecordBlock message;
    message.set_first(7);
    message.set_encoding(static_cast<v1::RecordEncoding>(9));
    EXPECT_EQ(from_proto(message).error().cause, Cause::kCorrupt);
    EXPECT_EQ(*from_proto(v1::RECORD_ENCODING_UNSPECIFIED), RecordEncoding::kFloat64);
}

TEST(ConvertTest, ProgressAndViolationKeepEveryField) {
    const v1::Progress progress = to_proto(Progress{"simplify", 0.25, 1234});
    EXPECT_EQ(progress.stage(), "simplify");
    EXPECT_EQ(progress.fraction(), 0.25);
    EXPECT_EQ(progress.faces(), 1234U);
    const v1::Violation violation = to_proto(Violation{"max_size", 2, 3.5, 2, {8, 9}, "because \xff"});
    EXPECT_EQ(violation.bound(), "max_size");
    EXPECT_EQ(violation.worst(), 3.5);
    EXPECT_EQ(violation.elements(1), 9U);
    EXPECT_EQ(violation.reason(), "because ?");
}

}  // namespace
}  // namespace vsplit::wire
