#include "grpc/replies.h"

#include <chrono>

#include "wire/convert.h"
#include "wire/representation.h"

namespace vsplit::rpc {
namespace {

void set_time(std::chrono::system_clock::time_point time, google::protobuf::Timestamp& proto) {
    const auto since = time.time_since_epoch();
    const auto seconds = std::chrono::floor<std::chrono::seconds>(since);
    proto.set_seconds(seconds.count());
    proto.set_nanos(static_cast<std::int32_t>(std::chrono::duration_cast<std::chrono::nanoseconds>(since - seconds).count()));
}

/// Lists of sessions must stay small.
void shorten_violations(v1::Representation& proto) {
    constexpr int kExamples = 16;
    for (v1::Violation& violation : *proto.mutable_violations()) {
        if (violation.elements_size() > kExamples) violation.mutable_elements()->Truncate(kExamples);
    }
}

}  // namespace

void shorten_groups(v1::Session& session) {
    constexpr int kExamples = 10;
    if (session.source().groups_size() > kExamples) {
        auto& groups = *session.mutable_source()->mutable_groups();
        groups.DeleteSubrange(kExamples, groups.size() - kExamples);
    }
}

v1::Session to_proto(const service::SessionSnapshot& session) {
    v1::Session proto;
    proto.set_id(session.id);
    set_time(session.create_time, *proto.mutable_create_time());
    set_time(session.expire_time, *proto.mutable_expire_time());
    if (session.source) *proto.mutable_source() = wire::to_proto(session.source->report);
    for (const auto& representation : session.representations) {
        v1::Representation& entry = *proto.add_representations();
        entry = to_proto(*representation);
        shorten_violations(entry);
    }
    for (const service::MethodRequest& method : session.interrupted) {
        *proto.add_interrupted() = wire::describe_interrupted(method.source.representation, method.source.faces, method.options);
    }
    return proto;
}

v1::Representation to_proto(const service::Representation& representation) {
    const service::MeshRef& source = representation.source();
    return wire::describe(representation.id(), source.representation, source.faces, representation.figures(),
                          representation.extent());
}

v1::Representation to_proto(const service::Representation& representation, const service::Levels& levels, std::size_t level) {
    v1::Representation proto = to_proto(representation);
    if (!levels.mrr().regions.empty()) wire::set_groups(list_groups(*levels.mesh(level)), proto);
    const std::uint32_t made_for = representation.figures().faces;
    if (levels.mrr().faces_at(level) == made_for) return proto;
    wire::describe_quality(*levels.quality(level), proto);
    if (proto.has_control_options()) wire::describe_bounds(*levels.mesh(level), proto);
    return proto;
}

}  // namespace vsplit::rpc
