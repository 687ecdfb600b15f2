#include "cli/remote_run.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "cli/file_hash.h"
#include "cli/input_check.h"
#include "cli/local_run.h"
#include "cli/message.h"
#include "cli/remote_session.h"
#include "cli/server_access.h"
#include "vsplit/client/mesh_receiver.h"
#include "vsplit/client/meshing_client.h"
#include "vsplit/method/method_options.h"
#include "wire/convert.h"
#include "wire/features.h"

namespace vsplit::cli {
namespace {

Error invalid(const std::string& message, const char* field) { return {Cause::kInvalidOption, message, field}; }

Status check_input(const Arguments& a) {
    const bool none = a.input.empty() || a.input == "-";
    if (a.session.empty() && none) return invalid("a file is needed to upload, or a session that holds one", "input");
    if (!a.session.empty() && !none) return invalid("with a session nothing is uploaded; leave IN out, or give -", "input");
    if (!a.session.empty() && a.unit) return invalid("the session's mesh has its unit from its upload; leave it out", "unit");
    if (!a.session.empty() && a.keep) return invalid("a session that is named is kept anyway", "keep");
    if (a.session.empty() && !a.representation.empty())
        return invalid("a new session has no representations; name a session", "session");
    return Done{};
}

Status check_arguments(const Arguments& a) {
    if (Status valid = check_input(a); !valid) return valid;
    if (Status applies = check_reading(a); !applies) return applies;
    if (!a.against.empty()) return invalid("two meshes are compared without a server; leave --server out", "against");
    const bool method = a.verb == Verb::kImprove || a.verb == Verb::kControl;
    const bool features = a.verb == Verb::kFeatures || a.verb == Verb::kRemoveFeatures;
    if (features && !a.representation.empty()) return invalid("features are those of the upload", "representation");
    if (!method && !features && is_representation_file(a.input)) {
        return invalid("a .vsplit file is read without a server; leave --server out", "server");
    }
    if (a.verb == Verb::kResolution && a.session.empty()) return invalid("a session with a representation is needed", "session");
    if (!method && a.verb != Verb::kResolution && a.faces && a.representation.empty()) {
        return invalid("the upload has one resolution; name a representation", "representation");
    }
    if (a.source_faces && a.representation.empty() && !is_representation_file(a.input)) {
        return invalid("a mesh has one resolution; accepted with --representation or a .vsplit file", "source_faces");
    }
    return Done{};
}

/// One command on one session.
class RemoteRun {
public:
    RemoteRun(client::MeshingClient& client, const RemoteSession& session, const Arguments& arguments,
              const std::vector<Output>& outputs, ProgressBar& progress, const std::stop_token& stop)
        : client_(client), session_(session), arguments_(arguments), outputs_(outputs), progress_(progress), call_{{}, stop} {}

    Expected<Outcome> run() {
        switch (arguments_.verb) {
            case Verb::kImprove:
                return improve();
            case Verb::kControl:
                return control();
            case Verb::kResolution:
                return resolution();
            case Verb::kInfo:
            case Verb::kQuality:
                return arguments_.representation.empty() ? describe_upload() : describe_representation();
            case Verb::kFeatures:
                return features();
            case Verb::kRemoveFeatures:
                return remove_features();
        }
        return Error{Cause::kInternal, "no such verb", ""};
    }

private:
    client::EventHandlers handlers() {
        return receiver_.handlers([this](const v1::Progress& p) { progress_.show(p.stage(), p.fraction(), p.faces()); });
    }

    void set_source(v1::MeshSource& source) const {
        source.set_representation(arguments_.representation);
        if (!arguments_.representation.empty()) source.set_faces(arguments_.source_faces.value_or(0));
    }

    Expected<Outcome> improve() {
        if (Status valid = check_options(arguments_.improve); !valid) return valid.error();
        v1::ImproveRequest request;
        request.set_session(session_.id());
        set_source(*request.mutable_source());
        *request.mutable_options() = wire::to_proto(arguments_.improve);
        return received(with_findings(client_.improve(request, handlers(), call_)));
    }

    Expected<Outcome> control() {
        if (Status valid = check_options(arguments_.control); !valid) return valid.error();
        v1::ControlRequest request;
        request.set_session(session_.id());
        set_source(*request.mutable_source());
        *request.mutable_options() = wire::to_proto(arguments_.control);
        return received(with_findings(client_.control(request, handlers(), call_)));
    }

    /// What the session tells of the upload, where that was worked on.
    Expected<v1::Representation> with_findings(Expected<v1::Representation> made) const {
        if (made && arguments_.representation.empty() && !is_representation_file(arguments_.input))
            *made->mutable_source_findings() = session_.session().source().findings();
        return made;
    }

    v1::SetResolutionRequest resolution_request(const std::string& representation, std::uint32_t held,
                                                std::uint32_t faces) const {
        v1::SetResolutionRequest request;
        request.set_session(session_.id());
        request.set_representation(representation);
        request.set_faces_held(held);
        request.set_faces(faces);
        return request;
    }

    /// The resolution that the representation asked for was made for; 0 where the session has none such, for the server to say
    /// so.
    std::uint32_t own_resolution() const {
        const auto& all = session_.session().representations();
        if (arguments_.representation.empty()) return all.empty() ? 0 : all.rbegin()->faces();
        const auto found = std::find_if(all.begin(), all.end(),
                                        [&](const v1::Representation& r) { return r.id() == arguments_.representation; });
        return found == all.end() ? 0 : found->faces();
    }

    Expected<Outcome> resolution() {
        const std::uint32_t faces = arguments_.faces ? *arguments_.faces : own_resolution();
        const auto request = resolution_request(arguments_.representation, 0, faces);
        return received(client_.set_resolution(request, handlers(), call_));
    }

    /// What a stream brought: the mesh at the representation's resolution, and all of it where a .vsplit file is asked for.
    Expected<Outcome> received(Expected<v1::Representation> made) {
        if (!made) return made.error();
        if (wants_representation(outputs_)) {
            const auto request = resolution_request(made->id(), receiver_.faces_held(), made->faces_max());
            const auto finest = client_.set_resolution(request, handlers(), call_);
            if (!finest) return finest.error();
        }
        if (Status shown = receiver_.show(made->faces()); !shown) return shown.error();
        if (receiver_.mesh().face_count() != made->faces()) {
            return Error{Cause::kCorrupt,
                         "the server sent a mesh of " + std::to_string(receiver_.mesh().face_count()) +
                             " faces and describes one of " + std::to_string(made->faces()),
                         ""};
        }
        std::optional<StoredMrr> whole;
        if (wants_representation(outputs_)) {
            Expected<StoredMrr> stored = stored_whole();
            if (!stored) return stored.error();
            whole = *std::move(stored);
        }
        if (arguments_.order != 2) return Outcome{*std::move(made), receiver_.mesh(), std::move(whole)};
        // The surface that mid-side nodes are put on is with the server.
        if (Status downloaded = download(made->id(), made->faces()); !downloaded) return downloaded.error();
        return Outcome{*std::move(made), {}, std::move(whole), {}, sent_surface_note(arguments_.input)};
    }

    /// All that has come; which file it was made from is known where this command has sent it.
    Expected<StoredMrr> stored_whole() {
        StoredMrr stored{receiver_.held(), 0, ""};
        if (!arguments_.session.empty()) return stored;
        const Expected<SourceHash> hash = hash_of_file(arguments_.input);
        if (!hash) return hash.error();
        stored.source = *hash;
        return stored;
    }

    Expected<v1::Quality> quality() {
        v1::GetQualityRequest request;
        request.set_session(session_.id());
        request.set_representation(arguments_.representation);
        request.set_faces(arguments_.faces.value_or(0));
        request.set_worst(kWorstFaces);
        request.set_profile(arguments_.profile);
        return client_.get_quality(request, call_);
    }

    Expected<Outcome> describe_upload() {
        if (!session_.session().has_source()) {
            return Error{Cause::kNotReady, "session " + session_.id() + " has no mesh yet", "session"};
        }
        v1::MeshSummary summary = session_.session().source();
        if (arguments_.verb == Verb::kQuality) {
            Expected<v1::Quality> measured = quality();
            if (!measured) return measured.error();
            *summary.mutable_quality() = *std::move(measured);
        }
        if (Status downloaded = download("", 0); !downloaded) return downloaded.error();
        return Outcome{std::move(summary), {}, {}};
    }

    v1::ListFeaturesRequest features_request() const {
        v1::ListFeaturesRequest request;
        request.set_session(session_.id());
        request.set_angle(arguments_.removal.search.angle);
        return request;
    }

    Expected<Outcome> features() {
        Expected<v1::ListFeaturesResponse> list = client_.list_features(features_request(), call_);
        if (!list) return list.error();
        if (Status downloaded = download("", 0); !downloaded) return downloaded.error();
        return Outcome{*std::move(list), {}, {}};
    }

    Expected<Outcome> remove_features() {
        const FeatureRemoval& removal = arguments_.removal;
        v1::RemoveFeaturesRequest request;
        request.set_session(session_.id());
        request.set_angle(removal.search.angle);
        request.mutable_ids()->Assign(removal.ids.begin(), removal.ids.end());
        if (removal.max_diameter) request.set_max_diameter(*removal.max_diameter);
        for (const ShapeFeature::Kind kind : removal.kinds) request.add_kinds(wire::to_proto(kind));
        Expected<v1::RemoveFeaturesResponse> done = client_.remove_features(request, call_);
        if (!done) return done.error();
        std::string note;
        if (done->removed().empty() && done->kept().empty()) {
            const Expected<v1::ListFeaturesResponse> list = client_.list_features(features_request(), call_);
            if (!list) return list.error();
            note = nothing_removed_note(removal, *list);
        }
        if (Status downloaded = download("", 0); !downloaded) return downloaded.error();
        return Outcome{*std::move(done), {}, {}, {}, std::move(note)};
    }

    /// Of a representation, or of the upload where its id is empty.
    Status download(const std::string& representation, std::uint32_t faces_asked) {
        for (const Output& output : outputs_) {
            if (!output.format) continue;  // write_outputs says that there is no representation
            v1::DownloadMeshRequest request;
            request.set_session(session_.id());
            request.set_format(wire::to_proto(output.format));
            request.set_order(arguments_.order);
            request.set_unit(wire::to_proto(arguments_.output_unit));
            request.set_representation(representation);
            request.set_faces(faces_asked);
            const auto faces = client_.download_mesh(request, output.path, call_);
            if (!faces) return faces.error();
        }
        return Done{};
    }

    /// The mesh itself comes only where it is to be written: who says he holds the resolution is sent no records.
    Expected<Outcome> describe_representation() {
        Expected<v1::Quality> measured = quality();
        if (!measured) return measured.error();
        const std::uint32_t held = outputs_.empty() ? measured->faces() : 0;
        const auto request = resolution_request(arguments_.representation, held, measured->faces());
        auto described = client_.set_resolution(request, handlers(), call_);
        if (!described) return described.error();
        if (arguments_.verb == Verb::kQuality) *described->mutable_quality() = *std::move(measured);
        if (outputs_.empty()) return Outcome{*std::move(described), {}, {}};
        return received(std::move(described));
    }

    client::MeshingClient& client_;
    const RemoteSession& session_;
    const Arguments& arguments_;
    const std::vector<Output>& outputs_;
    ProgressBar& progress_;
    client::CallOptions call_;
    client::MeshReceiver receiver_;
};

}  // namespace

Expected<Outcome> run_on_server(const Arguments& arguments, const std::vector<Output>& outputs, ProgressBar& progress,
                                const std::stop_token& stop) {
    if (Status valid = check_arguments(arguments); !valid) return valid.error();
    const Expected<client::ConnectOptions> connect = connect_options(arguments, stop);
    if (!connect) return connect.error();
    Expected<client::MeshingClient> client = client::MeshingClient::connect(arguments.server, *connect);
    if (!client) return client.error();
    const Expected<RemoteSession> session = RemoteSession::open(*client, arguments, progress, stop);
    if (!session) return session.error();
    const std::optional<LengthUnit> unit = unit_of(session->session().source());
    if (Status writable = check_units(outputs, unit, arguments); !writable) return writable.error();
    return RemoteRun(*client, *session, arguments, outputs, progress, stop).run();
}

}  // namespace vsplit::cli
