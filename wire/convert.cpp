#include "wire/convert.h"

#include <algorithm>
#include <string>
#include <utility>

#include "wire/utf8.h"

namespace vsplit::wire {
namespace {

/// Sentences may quote a file's bytes; a proto3 string must be UTF-8.
std::string sentence(const std::string& text) { return valid_utf8(text, 4096); }

template <class Elements>
void add_elements(const Elements& elements, google::protobuf::RepeatedField<std::uint32_t>& field) {
    field.Add(elements.begin(), elements.end());
}

Error unknown_number(const char* field, int number, const char* accepted) {
    return {Cause::kInvalidOption,
            std::string(field) + " is " + std::to_string(number) + ", which names none; accepted is " + accepted, field};
}

/// What both methods' options share, out of core.
template <class Options, class Proto>
void set_common(const Options& options, Proto& proto) {
    if (options.tolerance) proto.set_tolerance(*options.tolerance);
    if (options.max_deviation) proto.set_max_deviation(*options.max_deviation);
    if (options.feature_angle) proto.set_feature_angle(*options.feature_angle);
    if (options.feature_weight) proto.set_feature_weight(*options.feature_weight);
    if (options.faces) proto.set_faces(*options.faces);
    if (options.faces_min) proto.set_faces_min(*options.faces_min);
    proto.set_mode(to_proto(options.mode));
    proto.set_feature_detection(to_proto(options.feature_detection));
    add_elements(options.marked_edges, *proto.mutable_marked_edges());
    add_elements(options.regions, *proto.mutable_regions());
    if (options.sizing) *proto.mutable_sizing() = to_proto(*options.sizing);
    if (options.freeze_boundary) proto.set_freeze_boundary(*options.freeze_boundary);
}

/// What both methods' options share, into core.
template <class Proto, class Options>
Status get_common(const Proto& proto, Options& options) {
    if (proto.has_tolerance()) options.tolerance = proto.tolerance();
    if (proto.has_max_deviation()) options.max_deviation = proto.max_deviation();
    if (proto.has_feature_angle()) options.feature_angle = proto.feature_angle();
    if (proto.has_feature_weight()) options.feature_weight = proto.feature_weight();
    if (proto.has_faces()) options.faces = proto.faces();
    if (proto.has_faces_min()) options.faces_min = proto.faces_min();
    Expected<std::optional<Mode>> mode = from_proto(proto.mode());
    if (!mode) return mode.error();
    options.mode = *mode;
    Expected<std::optional<FeatureDetection>> detection = from_proto(proto.feature_detection());
    if (!detection) return detection.error();
    options.feature_detection = *detection;
    options.marked_edges.assign(proto.marked_edges().begin(), proto.marked_edges().end());
    options.regions.assign(proto.regions().begin(), proto.regions().end());
    if (proto.has_sizing()) options.sizing = from_proto(proto.sizing());
    if (proto.has_freeze_boundary()) options.freeze_boundary = proto.freeze_boundary();
    return Done{};
}

}  // namespace

v1::Vector to_proto(const Vec3& point) {
    v1::Vector proto;
    proto.set_x(point.x());
    proto.set_y(point.y());
    proto.set_z(point.z());
    return proto;
}

Vec3 from_proto(const v1::Vector& vector) { return {vector.x(), vector.y(), vector.z()}; }

v1::BoundingBox to_proto(const BoundingBox& box) {
    v1::BoundingBox proto;
    if (box.empty()) return proto;
    *proto.mutable_min() = to_proto(box.min);
    *proto.mutable_max() = to_proto(box.max);
    return proto;
}

v1::Quality to_proto(const Quality& quality, std::span<const FaceQuality> worst) {
    v1::Quality proto;
    proto.set_faces(quality.faces);
    proto.set_stretch_min(quality.stretch_min);
    proto.set_stretch_mean(quality.stretch_mean);
    proto.set_stretch_p01(quality.stretch_p01);
    proto.set_faces_below_02(quality.faces_below_02);
    proto.set_size_max(quality.size_max);
    proto.set_valence_max(quality.valence_max);
    add_elements(quality.stretch_histogram, *proto.mutable_stretch_histogram());
    if (quality.deviation_max) proto.set_deviation_max(*quality.deviation_max);
    if (quality.crease_deviation_max) proto.set_crease_deviation_max(*quality.crease_deviation_max);
    for (const FaceQuality& face : worst) {
        v1::FaceQuality& entry = *proto.add_worst_faces();
        entry.set_face(face.face);
        entry.set_stretch(face.stretch);
        entry.set_size(face.size);
        *entry.mutable_centroid() = to_proto(face.centroid);
    }
    return proto;
}

v1::Finding to_proto(const Finding& finding) {
    v1::Finding proto;
    proto.set_kind(std::string(finding_name(finding.kind)));
    proto.set_count(finding.count);
    proto.set_message(sentence(finding.message));
    add_elements(finding.elements, *proto.mutable_elements());
    for (std::size_t i = 0; i < std::min(finding.places.size(), Finding::kExamples); ++i)
        *proto.add_places() = to_proto(finding.places[i]);
    return proto;
}

v1::FaceGroup to_proto(const FaceGroup& group) {
    constexpr std::size_t kNameBytes = 256;
    v1::FaceGroup proto;
    proto.set_name(valid_utf8(group.name, kNameBytes));
    add_elements(group.regions, *proto.mutable_regions());
    proto.set_faces(group.faces);
    return proto;
}

v1::MeshSummary to_proto(const MeshReport& report) {
    v1::MeshSummary proto;
    proto.set_vertices(report.vertices);
    proto.set_faces(report.faces);
    proto.set_closed(report.closed);
    proto.set_components(report.components);
    proto.set_genus(report.genus);
    proto.set_boundary_edges(report.boundary_edges);
    *proto.mutable_bounding_box() = to_proto(report.box);
    *proto.mutable_quality() = to_proto(report.quality);
    for (const Finding& finding : report.findings) *proto.add_findings() = to_proto(finding);
    proto.set_unit(to_proto(report.unit));
    proto.mutable_quality()->set_unit(proto.unit());
    set_groups(report.groups, proto);
    return proto;
}

v1::Violation to_proto(const Violation& violation) {
    v1::Violation proto;
    proto.set_bound(violation.bound);
    proto.set_limit(violation.limit);
    proto.set_worst(violation.worst);
    proto.set_count(violation.count);
    add_elements(violation.elements, *proto.mutable_elements());
    proto.set_reason(sentence(violation.reason));
    return proto;
}

v1::Slivers to_proto(const Slivers& slivers) {
    v1::Slivers proto;
    proto.set_cause(std::string(sliver_cause_name(slivers.cause)));
    proto.set_count(slivers.count);
    add_elements(slivers.elements, *proto.mutable_elements());
    proto.set_message(sentence(slivers.message));
    proto.set_least(slivers.least);
    proto.set_most(slivers.most);
    return proto;
}

v1::RecordCounts count_records(const MrrExtent& extent) {
    v1::RecordCounts proto;
    proto.set_splits(extent.splits);
    proto.set_flips(extent.flips);
    proto.set_moves(extent.moves);
    return proto;
}

v1::Progress to_proto(const Progress& progress) {
    v1::Progress proto;
    proto.set_stage(std::string(progress.stage));
    proto.set_fraction(progress.fraction);
    proto.set_faces(progress.faces);
    return proto;
}

v1::Mode to_proto(std::optional<Mode> mode) {
    if (!mode) return v1::MODE_UNSPECIFIED;
    return *mode == Mode::kStrict ? v1::STRICT : v1::EXTENDED;
}

Expected<std::optional<Mode>> from_proto(v1::Mode mode) {
    switch (mode) {
        case v1::MODE_UNSPECIFIED:
            return std::optional<Mode>();
        case v1::STRICT:
            return std::optional(Mode::kStrict);
        case v1::EXTENDED:
            return std::optional(Mode::kExtended);
        default:
            return unknown_number("mode", mode, "MODE_UNSPECIFIED, STRICT or EXTENDED");
    }
}

v1::FeatureDetection to_proto(std::optional<FeatureDetection> detection) {
    if (!detection) return v1::FEATURE_DETECTION_UNSPECIFIED;
    return *detection == FeatureDetection::kDihedral ? v1::DIHEDRAL : v1::NORMAL_VOTING;
}

Expected<std::optional<FeatureDetection>> from_proto(v1::FeatureDetection detection) {
    switch (detection) {
        case v1::FEATURE_DETECTION_UNSPECIFIED:
            return std::optional<FeatureDetection>();
        case v1::DIHEDRAL:
            return std::optional(FeatureDetection::kDihedral);
        case v1::NORMAL_VOTING:
            return std::optional(FeatureDetection::kNormalVoting);
        default:
            return unknown_number("feature_detection", detection, "FEATURE_DETECTION_UNSPECIFIED, DIHEDRAL or NORMAL_VOTING");
    }
}

v1::Sizing to_proto(const SizingOptions& options) {
    v1::Sizing proto;
    for (const SizeSphere& sphere : options.spheres) {
        v1::SizeSphere& entry = *proto.add_spheres();
        *entry.mutable_center() = to_proto(sphere.center);
        entry.set_radius(sphere.radius);
        entry.set_size(sphere.size);
    }
    for (const SizeBox& box : options.boxes) {
        v1::SizeBox& entry = *proto.add_boxes();
        *entry.mutable_min() = to_proto(box.min);
        *entry.mutable_max() = to_proto(box.max);
        entry.set_size(box.size);
    }
    proto.mutable_field()->Add(options.field.begin(), options.field.end());
    if (options.chord_error) proto.set_chord_error(*options.chord_error);
    proto.set_gradation(options.gradation);
    if (options.min_size) proto.set_min_size(*options.min_size);
    if (options.max_size) proto.set_max_size(*options.max_size);
    return proto;
}

SizingOptions from_proto(const v1::Sizing& proto) {
    SizingOptions options;
    for (const v1::SizeSphere& sphere : proto.spheres()) {
        options.spheres.push_back({from_proto(sphere.center()), sphere.radius(), sphere.size()});
    }
    for (const v1::SizeBox& box : proto.boxes()) {
        options.boxes.push_back({from_proto(box.min()), from_proto(box.max()), box.size()});
    }
    options.field.assign(proto.field().begin(), proto.field().end());
    if (proto.has_chord_error()) options.chord_error = proto.chord_error();
    if (proto.has_gradation()) options.gradation = proto.gradation();
    if (proto.has_min_size()) options.min_size = proto.min_size();
    if (proto.has_max_size()) options.max_size = proto.max_size();
    return options;
}

v1::ImproveOptions to_proto(const ImproveOptions& options) {
    v1::ImproveOptions proto;
    if (options.subdivision_size) proto.set_subdivision_size(*options.subdivision_size);
    if (options.min_stretch) proto.set_min_stretch(*options.min_stretch);
    if (options.min_mean_stretch) proto.set_min_mean_stretch(*options.min_mean_stretch);
    set_common(options, proto);
    return proto;
}

v1::ControlOptions to_proto(const ControlOptions& options) {
    v1::ControlOptions proto;
    if (options.subdivisions) proto.set_subdivisions(*options.subdivisions);
    if (options.min_stretch) proto.set_min_stretch(*options.min_stretch);
    if (options.max_size) proto.set_max_size(*options.max_size);
    if (options.max_valence) proto.set_max_valence(*options.max_valence);
    if (options.min_angle) proto.set_min_angle(*options.min_angle);
    if (options.max_angle) proto.set_max_angle(*options.max_angle);
    if (options.max_aspect_ratio) proto.set_max_aspect_ratio(*options.max_aspect_ratio);
    if (options.min_size) proto.set_min_size(*options.min_size);
    set_common(options, proto);
    return proto;
}

Expected<ImproveOptions> from_proto(const v1::ImproveOptions& options) {
    ImproveOptions result;
    if (options.has_subdivision_size()) result.subdivision_size = options.subdivision_size();
    if (options.has_min_stretch()) result.min_stretch = options.min_stretch();
    if (options.has_min_mean_stretch()) result.min_mean_stretch = options.min_mean_stretch();
    if (Status common = get_common(options, result); !common) return common.error();
    return result;
}

Expected<ControlOptions> from_proto(const v1::ControlOptions& options) {
    ControlOptions result;
    if (options.has_subdivisions()) result.subdivisions = options.subdivisions();
    if (options.has_min_stretch()) result.min_stretch = options.min_stretch();
    if (options.has_max_size()) result.max_size = options.max_size();
    if (options.has_max_valence()) result.max_valence = options.max_valence();
    if (options.has_min_angle()) result.min_angle = options.min_angle();
    if (options.has_max_angle()) result.max_angle = options.max_angle();
    if (options.has_max_aspect_ratio()) result.max_aspect_ratio = options.max_aspect_ratio();
    if (options.has_min_size()) result.min_size = options.min_size();
    if (Status common = get_common(options, result); !common) return common.error();
    return result;
}

v1::MeshFormat to_proto(std::optional<MeshFormat> format) {
    if (!format) return v1::MESH_FORMAT_UNSPECIFIED;
    switch (*format) {
        case MeshFormat::kStlBinary:
            return v1::STL;
        case MeshFormat::kStlAscii:
            return v1::STL_ASCII;
        case MeshFormat::kObj:
            return v1::OBJ;
        case MeshFormat::kPlyBinary:
            return v1::PLY;
        case MeshFormat::kPlyAscii:
            return v1::PLY_ASCII;
        case MeshFormat::kOff:
            return v1::OFF;
        case MeshFormat::kMsh:
            return v1::MSH;
        case MeshFormat::kMshAscii:
            return v1::MSH_ASCII;
        case MeshFormat::kMsh2:
            return v1::MSH2;
        case MeshFormat::kMsh2Ascii:
            return v1::MSH2_ASCII;
        case MeshFormat::kInp:
            return v1::INP;
        case MeshFormat::kBdf:
            return v1::BDF;
        case MeshFormat::kVtk:
            return v1::VTK;
        case MeshFormat::kVtkAscii:
            return v1::VTK_ASCII;
        case MeshFormat::kVtu:
            return v1::VTU;
        case MeshFormat::k3mf:
            return v1::THREE_MF;
    }
    return v1::MESH_FORMAT_UNSPECIFIED;
}

Expected<std::optional<MeshFormat>> from_proto(v1::MeshFormat format) {
    switch (format) {
        case v1::MESH_FORMAT_UNSPECIFIED:
            return std::optional<MeshFormat>();
        case v1::STL:
            return std::optional(MeshFormat::kStlBinary);
        case v1::STL_ASCII:
            return std::optional(MeshFormat::kStlAscii);
        case v1::OBJ:
            return std::optional(MeshFormat::kObj);
        case v1::PLY:
            return std::optional(MeshFormat::kPlyBinary);
        case v1::PLY_ASCII:
            return std::optional(MeshFormat::kPlyAscii);
        case v1::OFF:
            return std::optional(MeshFormat::kOff);
        case v1::MSH:
            return std::optional(MeshFormat::kMsh);
        case v1::MSH_ASCII:
            return std::optional(MeshFormat::kMshAscii);
        case v1::MSH2:
            return std::optional(MeshFormat::kMsh2);
        case v1::MSH2_ASCII:
            return std::optional(MeshFormat::kMsh2Ascii);
        case v1::INP:
            return std::optional(MeshFormat::kInp);
        case v1::BDF:
            return std::optional(MeshFormat::kBdf);
        case v1::VTK:
            return std::optional(MeshFormat::kVtk);
        case v1::VTK_ASCII:
            return std::optional(MeshFormat::kVtkAscii);
        case v1::VTU:
            return std::optional(MeshFormat::kVtu);
        case v1::THREE_MF:
            return std::optional(MeshFormat::k3mf);
        default:
            return unknown_number("format", format,
                                  "STL, STL_ASCII, OBJ, PLY, PLY_ASCII, OFF, MSH, MSH_ASCII, MSH2, MSH2_ASCII, INP, BDF, VTK, "
                                  "VTK_ASCII, VTU, THREE_MF, or none "
                                  "to tell it from the bytes");
    }
}

v1::LengthUnit to_proto(std::optional<LengthUnit> unit) {
    if (!unit) return v1::LENGTH_UNIT_UNSPECIFIED;
    switch (*unit) {
        case LengthUnit::kMicrometre:
            return v1::MICROMETRE;
        case LengthUnit::kMillimetre:
            return v1::MILLIMETRE;
        case LengthUnit::kCentimetre:
            return v1::CENTIMETRE;
        case LengthUnit::kMetre:
            return v1::METRE;
        case LengthUnit::kInch:
            return v1::INCH;
        case LengthUnit::kFoot:
            return v1::FOOT;
    }
    return v1::LENGTH_UNIT_UNSPECIFIED;
}

Expected<std::optional<LengthUnit>> from_proto(v1::LengthUnit unit) {
    if (unit == v1::LENGTH_UNIT_UNSPECIFIED) return std::optional<LengthUnit>();
    for (const LengthUnit known : length_units()) {
        if (to_proto(known) == unit) return std::optional(known);
    }
    return unknown_number("unit", unit, "MICROMETRE, MILLIMETRE, CENTIMETRE, METRE, INCH, FOOT, or none");
}

v1::ProfileReport to_proto(const ProfileReport& report) {
    v1::ProfileReport proto;
    switch (report.profile) {
        case QualityProfile::kStretch02:
            proto.set_profile(v1::STRETCH_02);
            break;
        case QualityProfile::kVerdict:
            proto.set_profile(v1::VERDICT);
            break;
        case QualityProfile::kOptistruct:
            proto.set_profile(v1::OPTISTRUCT);
            break;
    }
    proto.set_passed(report.passed);
    proto.set_warned(report.warned);
    proto.set_failed(report.failed);
    for (const CriterionReport& criterion : report.criteria) {
        v1::CriterionReport& added = *proto.add_criteria();
        added.set_name(criterion.name);
        added.set_worst(criterion.worst);
        added.set_worst_face(criterion.worst_face);
        added.set_warned(criterion.warned);
        added.set_failed(criterion.failed);
        added.set_upper(criterion.upper);
        added.set_warn_limit(criterion.warn_limit);
        added.set_fail_limit(criterion.fail_limit);
    }
    add_elements(report.worst, *proto.mutable_worst_faces());
    return proto;
}

Expected<std::optional<QualityProfile>> from_proto(v1::QualityProfile profile) {
    switch (profile) {
        case v1::QUALITY_PROFILE_UNSPECIFIED:
            return std::optional<QualityProfile>();
        case v1::STRETCH_02:
            return std::optional(QualityProfile::kStretch02);
        case v1::VERDICT:
            return std::optional(QualityProfile::kVerdict);
        case v1::OPTISTRUCT:
            return std::optional(QualityProfile::kOptistruct);
        default:
            return unknown_number("profile", profile, "STRETCH_02, VERDICT, OPTISTRUCT, or none");
    }
}

Expected<std::optional<RepairMode>> from_proto(v1::Repair repair) {
    switch (repair) {
        case v1::REPAIR_UNSPECIFIED:
            return std::optional<RepairMode>();
        case v1::NONE:
            return std::optional(RepairMode::kNone);
        case v1::SAFE:
            return std::optional(RepairMode::kSafe);
        case v1::FULL:
            return std::optional(RepairMode::kFull);
        default:
            return unknown_number("repair", repair, "NONE, SAFE or FULL");
    }
}

namespace {

template <class Request>
Expected<std::optional<RepairOptions>> repair_in(const Request& request) {
    const Expected<std::optional<RepairMode>> mode = from_proto(request.repair());
    if (!mode) return mode.error();
    RepairOptions options{.mode = mode->value_or(RepairMode::kNone)};
    if (request.has_stitch()) options.stitch = request.stitch();
    if (request.has_hole_size()) options.hole_size = request.hole_size();
    if (request.has_speck_size()) options.speck_size = request.speck_size();
    if (*mode) return std::optional(options);
    if (Status valid = check_options(options); !valid) return valid.error();
    return std::optional<RepairOptions>();
}

}  // namespace

Expected<std::optional<RepairOptions>> repair_of(const v1::CreateSessionRequest& request) { return repair_in(request); }

Expected<std::optional<RepairOptions>> repair_of(const v1::UploadMeshRequest& request) { return repair_in(request); }

v1::RecordEncoding to_proto(RecordEncoding encoding) {
    switch (encoding) {
        case RecordEncoding::kFloat64:
            return v1::FLOAT64;
        case RecordEncoding::kFloat32:
            return v1::FLOAT32;
        case RecordEncoding::kQuantised:
            return v1::QUANTISED;
    }
    return v1::RECORD_ENCODING_UNSPECIFIED;
}

Expected<RecordEncoding> from_proto(v1::RecordEncoding encoding) {
    switch (encoding) {
        case v1::RECORD_ENCODING_UNSPECIFIED:
        case v1::FLOAT64:
            return RecordEncoding::kFloat64;
        case v1::FLOAT32:
            return RecordEncoding::kFloat32;
        case v1::QUANTISED:
            return RecordEncoding::kQuantised;
        default:
            return unknown_number("encoding", encoding, "FLOAT64, FLOAT32 or QUANTISED");
    }
}

v1::RecordBlock to_proto(RecordBlock block) {
    v1::RecordBlock proto;
    proto.set_first(block.first);
    proto.set_count(block.count);
    proto.set_encoding(to_proto(block.encoding));
    proto.set_payload(std::move(block.payload));
    proto.set_crc32c(block.crc32c);
    return proto;
}

Expected<RecordBlock> from_proto(v1::RecordBlock block) {
    Expected<RecordEncoding> encoding = from_proto(block.encoding());
    if (!encoding) {
        return Error{Cause::kCorrupt,
                     "record block from record " + std::to_string(block.first()) + " on: " + encoding.error().message, ""};
    }
    return RecordBlock{block.first(), block.count(), *encoding, std::move(*block.mutable_payload()), block.crc32c()};
}

}  // namespace vsplit::wire
