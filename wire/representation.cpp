#include "wire/representation.h"

#include <cmath>

#include "vsplit/method/control.h"
#include "wire/convert.h"

namespace vsplit::wire {
namespace {

google::protobuf::Duration to_duration(std::chrono::duration<double> elapsed) {
    const double whole = std::floor(elapsed.count());
    google::protobuf::Duration proto;
    proto.set_seconds(static_cast<std::int64_t>(whole));
    proto.set_nanos(static_cast<std::int32_t>((elapsed.count() - whole) * 1e9));
    return proto;
}

/// Without what may be as large as the mesh: whoever has sent it knows it, and lists of representations must stay small.
template <class Options>
auto described(Options options) {
    options.marked_edges.clear();
    options.regions.clear();
    if (options.sizing) options.sizing->field.clear();
    return to_proto(options);
}

template <class Proto>
void set_options(const ImproveOptions& options, Proto& proto) {
    proto.set_method(v1::IMPROVE);
    *proto.mutable_improve_options() = described(options);
}

template <class Proto>
void set_options(const ControlOptions& options, Proto& proto) {
    proto.set_method(v1::CONTROL);
    *proto.mutable_control_options() = described(options);
}

/// What both messages say of a request.
template <class Proto>
void set_request(const std::string& source_representation, std::uint32_t source_faces, const MethodOptions& options,
                 Proto& proto) {
    proto.mutable_source()->set_representation(source_representation);
    proto.mutable_source()->set_faces(source_faces);
    std::visit([&](const auto& o) { set_options(o, proto); }, options);
}

Mode mode_of(const MethodOptions& options) {
    return std::visit([](const auto& o) { return o.mode.value_or(Mode::kExtended); }, options);
}

void set_violations(const std::vector<Violation>& violations, v1::Representation& proto) {
    proto.clear_violations();
    proto.set_bounds_satisfied(violations.empty());
    for (const Violation& violation : violations) *proto.add_violations() = to_proto(violation);
}

std::string reason_of(const v1::Representation& representation, const std::string& bound) {
    for (const v1::Violation& violation : representation.violations()) {
        if (violation.bound() == bound) return violation.reason();
    }
    return "the bounds were aimed at for another resolution of this representation";
}

}  // namespace

v1::Representation describe(const std::string& id, const std::string& source_representation, std::uint32_t source_faces,
                            const MethodFigures& figures, const MrrExtent& extent) {
    v1::Representation proto;
    proto.set_id(id);
    set_request(source_representation, source_faces, figures.options, proto);
    proto.set_mode(to_proto(mode_of(figures.options)));
    proto.set_faces_min(extent.faces_min);
    proto.set_faces_max(extent.faces_max);
    proto.set_faces(figures.faces);
    *proto.mutable_quality() = to_proto(figures.quality);
    set_violations(figures.violations, proto);
    for (const Slivers& slivers : figures.slivers) *proto.add_slivers() = to_proto(slivers);
    *proto.mutable_records() = count_records(extent);
    *proto.mutable_elapsed() = to_duration(figures.elapsed);
    proto.set_unit(to_proto(figures.unit));
    proto.mutable_quality()->set_unit(proto.unit());
    return proto;
}

v1::InterruptedMethod describe_interrupted(const std::string& source_representation, std::uint32_t source_faces,
                                           const MethodOptions& options) {
    v1::InterruptedMethod proto;
    set_request(source_representation, source_faces, options, proto);
    return proto;
}

void describe_resolution(const TriangleMesh& mesh, v1::Representation& representation) {
    describe_quality(measure_quality(mesh), representation);
    describe_bounds(mesh, representation);
    set_groups(list_groups(mesh), representation);
}

void describe_quality(const Quality& quality, v1::Representation& representation) {
    representation.set_faces(quality.faces);
    *representation.mutable_quality() = to_proto(quality);
    representation.mutable_quality()->set_unit(representation.unit());
    representation.clear_slivers();  // they were told with the source at hand, and name faces of another resolution
}

void describe_bounds(const TriangleMesh& mesh, v1::Representation& representation) {
    if (!representation.has_control_options()) return;
    const Expected<ControlOptions> options = from_proto(representation.control_options());
    if (!options) return;  // a mode of a later version: its bounds cannot be judged here
    std::vector<Violation> violations = find_violations(mesh, *options);
    for (Violation& violation : violations) violation.reason = reason_of(representation, violation.bound);
    set_violations(violations, representation);
}

}  // namespace vsplit::wire
