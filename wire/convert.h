#pragma once

#include <optional>
#include <span>

#include "vsplit/base/execution_context.h"
#include "vsplit/base/expected.h"
#include "vsplit/io/mesh_format.h"
#include "vsplit/mesh/face_groups.h"
#include "vsplit/mesh/inspect.h"
#include "vsplit/mesh/length_unit.h"
#include "vsplit/method/method_options.h"
#include "vsplit/method/method_result.h"
#include "vsplit/mrr/mrr_extent.h"
#include "vsplit/mrr/record_block.h"
#include "vsplit/quality/element_quality.h"
#include "vsplit/quality/mesh_quality.h"
#include "vsplit/repair/repair_mesh.h"
#include "vsplit/v1/meshing.pb.h"

/// Core's values as messages (to_proto) and back (from_proto). Every function is O(size of its argument).
namespace vsplit::wire {

[[nodiscard]] v1::Vector to_proto(const Vec3& point);

/// Absent coordinates are 0.
[[nodiscard]] Vec3 from_proto(const v1::Vector& vector);

/// An empty box has neither corner.
[[nodiscard]] v1::BoundingBox to_proto(const BoundingBox& box);

/// `worst` becomes worst_faces.
[[nodiscard]] v1::Quality to_proto(const Quality& quality, std::span<const FaceQuality> worst = {});

[[nodiscard]] v1::Finding to_proto(const Finding& finding);

[[nodiscard]] v1::FaceGroup to_proto(const FaceGroup& group);

/// `groups` and `group_count` of a message that has them.
template <class Proto>
void set_groups(const FaceGroups& groups, Proto& proto) {
    proto.clear_groups();
    for (const FaceGroup& group : groups.listed) *proto.add_groups() = to_proto(group);
    proto.set_group_count(groups.count);
}

[[nodiscard]] v1::MeshSummary to_proto(const MeshReport& report);

[[nodiscard]] v1::Violation to_proto(const Violation& violation);
[[nodiscard]] v1::Slivers to_proto(const Slivers& slivers);
[[nodiscard]] v1::RecordCounts count_records(const MrrExtent& extent);

[[nodiscard]] v1::Progress to_proto(const Progress& progress);

/// Empty becomes MODE_UNSPECIFIED.
[[nodiscard]] v1::Mode to_proto(std::optional<Mode> mode);

/// MODE_UNSPECIFIED becomes empty. \return INVALID_OPTION (field "mode") for a number that is no mode.
[[nodiscard]] Expected<std::optional<Mode>> from_proto(v1::Mode mode);

/// Empty becomes FEATURE_DETECTION_UNSPECIFIED.
[[nodiscard]] v1::FeatureDetection to_proto(std::optional<FeatureDetection> detection);

/// FEATURE_DETECTION_UNSPECIFIED becomes empty. \return INVALID_OPTION (field "feature_detection") for a number that is none.
[[nodiscard]] Expected<std::optional<FeatureDetection>> from_proto(v1::FeatureDetection detection);

[[nodiscard]] v1::Sizing to_proto(const SizingOptions& options);

/// An absent gradation is the default; ranges are for check_sizing.
[[nodiscard]] SizingOptions from_proto(const v1::Sizing& proto);

[[nodiscard]] v1::ImproveOptions to_proto(const ImproveOptions& options);
[[nodiscard]] v1::ControlOptions to_proto(const ControlOptions& options);

/// Fields that are absent stay empty; ranges are for check_options. \return INVALID_OPTION for a mode or a detection that is
/// none.
[[nodiscard]] Expected<ImproveOptions> from_proto(const v1::ImproveOptions& options);
[[nodiscard]] Expected<ControlOptions> from_proto(const v1::ControlOptions& options);

/// Empty becomes MESH_FORMAT_UNSPECIFIED.
[[nodiscard]] v1::MeshFormat to_proto(std::optional<MeshFormat> format);

/// MESH_FORMAT_UNSPECIFIED becomes empty. \return INVALID_OPTION (field "format") for a number that is no format.
[[nodiscard]] Expected<std::optional<MeshFormat>> from_proto(v1::MeshFormat format);

/// Empty becomes LENGTH_UNIT_UNSPECIFIED.
[[nodiscard]] v1::LengthUnit to_proto(std::optional<LengthUnit> unit);

/// LENGTH_UNIT_UNSPECIFIED becomes empty. \return INVALID_OPTION (field "unit") for a number that is no unit.
[[nodiscard]] Expected<std::optional<LengthUnit>> from_proto(v1::LengthUnit unit);

[[nodiscard]] v1::ProfileReport to_proto(const ProfileReport& report);
/// Empty where none is named. \return INVALID_OPTION for a number that names none.
[[nodiscard]] Expected<std::optional<QualityProfile>> from_proto(v1::QualityProfile profile);
/// Empty where none is named. \return INVALID_OPTION for a number that names none.
[[nodiscard]] Expected<std::optional<RepairMode>> from_proto(v1::Repair repair);
/// What a request asks to be mended, its lengths unchecked; empty where nothing is to be. \return INVALID_OPTION for lengths
/// without a repair.
[[nodiscard]] Expected<std::optional<RepairOptions>> repair_of(const v1::CreateSessionRequest& request);
[[nodiscard]] Expected<std::optional<RepairOptions>> repair_of(const v1::UploadMeshRequest& request);

[[nodiscard]] v1::RecordEncoding to_proto(RecordEncoding encoding);

/// Unspecified becomes kFloat64. \return INVALID_OPTION (field "encoding") for one this version does not know.
[[nodiscard]] Expected<RecordEncoding> from_proto(v1::RecordEncoding encoding);

/// `encoding` and `quantisation_bits` of a request, defaults filled in. \return also what check_encoding returns.
template <class Request>
[[nodiscard]] Expected<EncodingChoice> encoding_of(const Request& request) {
    const Expected<RecordEncoding> encoding = from_proto(request.encoding());
    if (!encoding) return encoding.error();
    return check_encoding({*encoding, request.quantisation_bits()});
}

/// Takes the payload over instead of copying it where the argument is given away.
[[nodiscard]] v1::RecordBlock to_proto(RecordBlock block);

/// \return CORRUPT for an unknown encoding; the rest is for decode_block to check.
[[nodiscard]] Expected<RecordBlock> from_proto(v1::RecordBlock block);

}  // namespace vsplit::wire
