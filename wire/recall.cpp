#include "wire/recall.h"

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "wire/convert.h"

namespace vsplit::wire {
namespace {

/// The value from 0 to `last` that `name_of` calls `name`.
template <class Enum, class NameOf>
Expected<Enum> named(const std::string& name, const NameOf& name_of, Enum last) {
    for (int value = 0; value <= static_cast<int>(last); ++value) {
        if (name_of(static_cast<Enum>(value)) == name) return static_cast<Enum>(value);
    }
    return Error{Cause::kCorrupt, "'" + name + "' is no name that is known", ""};
}

Expected<Finding> finding_of(const v1::Finding& proto) {
    const Expected<Finding::Kind> kind = named(proto.kind(), finding_name, Finding::Kind::kEmptiedGroup);
    if (!kind) return kind.error();
    Finding finding;
    finding.kind = *kind;
    finding.count = proto.count();
    finding.message = proto.message();
    finding.elements.assign(proto.elements().begin(), proto.elements().end());
    for (const v1::Vector& place : proto.places()) finding.places.push_back(from_proto(place));
    return finding;
}

Violation violation_of(const v1::Violation& proto) {
    Violation violation;
    violation.bound = proto.bound();
    violation.limit = proto.limit();
    violation.worst = proto.worst();
    violation.count = proto.count();
    violation.elements.assign(proto.elements().begin(), proto.elements().end());
    violation.reason = proto.reason();
    return violation;
}

Expected<Slivers> slivers_of(const v1::Slivers& proto) {
    const Expected<SliverCause> cause = named(proto.cause(), sliver_cause_name, SliverCause::kUnexplained);
    if (!cause) return cause.error();
    Slivers slivers;
    slivers.cause = *cause;
    slivers.count = proto.count();
    slivers.least = proto.least();
    slivers.most = proto.most();
    slivers.elements.assign(proto.elements().begin(), proto.elements().end());
    slivers.message = proto.message();
    return slivers;
}

Expected<MethodOptions> options_of(const v1::Representation& representation) {
    if (representation.has_control_options()) {
        const Expected<ControlOptions> options = from_proto(representation.control_options());
        if (!options) return options.error();
        return MethodOptions(*options);
    }
    const Expected<ImproveOptions> options = from_proto(representation.improve_options());
    if (!options) return options.error();
    return MethodOptions(*options);
}

std::chrono::duration<double> to_seconds(const google::protobuf::Duration& duration) {
    return std::chrono::duration<double>(static_cast<double>(duration.seconds()) + 1e-9 * duration.nanos());
}

}  // namespace

BoundingBox from_proto(const v1::BoundingBox& box) {
    if (!box.has_min() || !box.has_max()) return {};
    return {from_proto(box.min()), from_proto(box.max())};
}

Expected<Quality> from_proto(const v1::Quality& proto) {
    Quality quality;
    const auto& histogram = proto.stretch_histogram();
    if (static_cast<std::size_t>(histogram.size()) != quality.stretch_histogram.size()) {
        return Error{Cause::kCorrupt, "the histogram of stretch has " + std::to_string(histogram.size()) + " counts", ""};
    }
    quality.faces = proto.faces();
    quality.stretch_min = proto.stretch_min();
    quality.stretch_mean = proto.stretch_mean();
    quality.stretch_p01 = proto.stretch_p01();
    quality.faces_below_02 = proto.faces_below_02();
    quality.size_max = proto.size_max();
    quality.valence_max = proto.valence_max();
    std::copy(histogram.begin(), histogram.end(), quality.stretch_histogram.begin());
    if (proto.has_deviation_max()) quality.deviation_max = proto.deviation_max();
    if (proto.has_crease_deviation_max()) quality.crease_deviation_max = proto.crease_deviation_max();
    return quality;
}

Expected<MeshReport> from_proto(const v1::MeshSummary& summary) {
    MeshReport report;
    report.vertices = summary.vertices();
    report.faces = summary.faces();
    report.closed = summary.closed();
    report.components = summary.components();
    report.genus = summary.genus();
    report.boundary_edges = summary.boundary_edges();
    report.box = from_proto(summary.bounding_box());
    const Expected<Quality> quality = from_proto(summary.quality());
    if (!quality) return quality.error();
    report.quality = *quality;
    for (const v1::Finding& proto : summary.findings()) {
        Expected<Finding> finding = finding_of(proto);
        if (!finding) return finding.error();
        report.findings.push_back(*std::move(finding));
    }
    const Expected<std::optional<LengthUnit>> unit = from_proto(summary.unit());
    if (!unit) return unit.error();
    report.unit = *unit;
    for (const v1::FaceGroup& group : summary.groups())
        report.groups.listed.push_back({group.name(), {group.regions().begin(), group.regions().end()}, group.faces()});
    report.groups.count = summary.group_count();
    return report;
}

Expected<MethodFigures> figures_of(const v1::Representation& representation) {
    MethodFigures figures;
    Expected<MethodOptions> options = options_of(representation);
    if (!options) return options.error();
    figures.options = *std::move(options);
    figures.faces = representation.faces();
    figures.faces_subdivided = representation.faces_max();
    const Expected<Quality> quality = from_proto(representation.quality());
    if (!quality) return quality.error();
    figures.quality = *quality;
    for (const v1::Violation& violation : representation.violations()) figures.violations.push_back(violation_of(violation));
    for (const v1::Slivers& proto : representation.slivers()) {
        Expected<Slivers> slivers = slivers_of(proto);
        if (!slivers) return slivers.error();
        figures.slivers.push_back(*std::move(slivers));
    }
    figures.elapsed = to_seconds(representation.elapsed());
    const Expected<std::optional<LengthUnit>> unit = from_proto(representation.unit());
    if (!unit) return unit.error();
    figures.unit = *unit;
    return figures;
}

}  // namespace vsplit::wire
