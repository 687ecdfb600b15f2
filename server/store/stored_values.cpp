#include "store/stored_values.h"

#include <utility>
#include <variant>

#include "store/stored.pb.h"
#include "wire/convert.h"
#include "wire/recall.h"
#include "wire/representation.h"

namespace vsplit::store {
namespace {

template <class Message>
Expected<Message> parse(const std::string& text, const char* what) {
    Message message;
    if (message.ParseFromString(text)) return message;
    return Error{Cause::kCorrupt, std::string("what the index says of a ") + what + " cannot be read", ""};
}

void set_options(const ImproveOptions& options, StoredRequest& proto) { *proto.mutable_improve() = wire::to_proto(options); }
void set_options(const ControlOptions& options, StoredRequest& proto) { *proto.mutable_control() = wire::to_proto(options); }

StoredRequest to_proto(const service::MethodRequest& request) {
    StoredRequest proto;
    proto.mutable_source()->set_representation(request.source.representation);
    proto.mutable_source()->set_faces(request.source.faces);
    std::visit([&](const auto& options) { set_options(options, proto); }, request.options);
    return proto;
}

Expected<service::MethodRequest> from_proto(const StoredRequest& proto) {
    service::MethodRequest request;
    request.source = {proto.source().representation(), proto.source().faces()};
    if (proto.has_control()) {
        Expected<ControlOptions> options = wire::from_proto(proto.control());
        if (!options) return options.error();
        request.options = *std::move(options);
    } else {
        Expected<ImproveOptions> options = wire::from_proto(proto.improve());
        if (!options) return options.error();
        request.options = *std::move(options);
    }
    return request;
}

}  // namespace

std::string write_source(const service::SourceMesh& source, const TriangleMesh& mesh, std::uint64_t blob_bytes) {
    const MeshReport& report = source.report;
    StoredSource proto;
    *proto.mutable_summary() = wire::to_proto(report);
    proto.set_non_manifold_edges(report.non_manifold_edges);
    proto.set_inconsistent_edges(report.inconsistent_edges);
    proto.set_non_manifold_vertices(report.non_manifold_vertices);
    proto.mutable_boundary_touches()->Add(report.boundary_touches.begin(), report.boundary_touches.end());
    proto.set_degenerate_faces(report.degenerate_faces);
    proto.set_duplicate_faces(report.duplicate_faces);
    for (const FaceSet& set : mesh.sets) {
        StoredSet& added = *proto.add_sets();
        added.set_name(set.name);
        added.mutable_regions()->Add(set.regions.begin(), set.regions.end());
    }
    proto.set_memory(source.mesh->bytes());
    proto.set_blob_bytes(blob_bytes);
    return proto.SerializeAsString();
}

Expected<ToldSource> read_source(const std::string& text) {
    const Expected<StoredSource> proto = parse<StoredSource>(text, "mesh");
    if (!proto) return proto.error();
    Expected<MeshReport> report = wire::from_proto(proto->summary());
    if (!report) return report.error();
    ToldSource told{*std::move(report), {}, proto->memory(), proto->blob_bytes()};
    told.report.non_manifold_edges = proto->non_manifold_edges();
    told.report.inconsistent_edges = proto->inconsistent_edges();
    told.report.non_manifold_vertices = proto->non_manifold_vertices();
    told.report.boundary_touches.assign(proto->boundary_touches().begin(), proto->boundary_touches().end());
    told.report.degenerate_faces = proto->degenerate_faces();
    told.report.duplicate_faces = proto->duplicate_faces();
    for (const StoredSet& set : proto->sets()) told.sets.push_back({set.name(), {set.regions().begin(), set.regions().end()}});
    return told;
}

std::string write_request(const service::MethodRequest& request) { return to_proto(request).SerializeAsString(); }

Expected<service::MethodRequest> read_request(const std::string& text) {
    const Expected<StoredRequest> proto = parse<StoredRequest>(text, "method");
    if (!proto) return proto.error();
    return from_proto(*proto);
}

std::string write_representation(const service::Representation& representation, std::uint64_t blob_bytes) {
    const service::MeshRef& source = representation.source();
    StoredRepresentation proto;
    *proto.mutable_description() = wire::describe(representation.id(), source.representation, source.faces,
                                                  representation.figures(), representation.extent());
    *proto.mutable_asked() = to_proto(representation.asked());
    proto.set_memory(representation.levels().bytes());
    proto.set_blob_bytes(blob_bytes);
    return proto.SerializeAsString();
}

Expected<ToldRepresentation> read_representation(const std::string& text) {
    const Expected<StoredRepresentation> proto = parse<StoredRepresentation>(text, "representation");
    if (!proto) return proto.error();
    Expected<service::MethodRequest> asked = from_proto(proto->asked());
    if (!asked) return asked.error();
    const v1::Representation& description = proto->description();
    Expected<MethodFigures> figures = wire::figures_of(description);
    if (!figures) return figures.error();
    const v1::RecordCounts& records = description.records();
    return ToldRepresentation{
        description.id(),
        *std::move(asked),
        *std::move(figures),
        {description.faces_min(), description.faces_max(), records.splits(), records.flips(), records.moves()},
        proto->memory(),
        proto->blob_bytes()};
}

}  // namespace vsplit::store
