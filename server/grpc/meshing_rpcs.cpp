#include "grpc/meshing_rpcs.h"

#include <span>
#include <string>
#include <utility>

#include "grpc/download_stream.h"
#include "grpc/level_stream.h"
#include "grpc/method_stream.h"
#include "grpc/pull_stream.h"
#include "grpc/replies.h"
#include "grpc/upload_stream.h"
#include "service/guarded.h"
#include "service/memory_use.h"
#include "service/session_features.h"
#include "vsplit/quality/mesh_quality.h"
#include "wire/convert.h"
#include "wire/describe_file.h"
#include "wire/error_table.h"
#include "wire/features.h"

namespace vsplit::rpc {
namespace {

constexpr std::uint32_t kDefaultWorst = 20;
constexpr std::uint32_t kMostWorst = 1000;

/// \pre the answer is not sent yet.
service::StillWanted wanted_by(const grpc::CallbackServerContext& context) {
    return [&context] { return !context.IsCancelled(); };
}

Error nobody_waits() { return {Cause::kCancelled, "the client is gone or its deadline has passed", ""}; }

void finish(grpc::ServerUnaryReactor* reactor, const RpcWatch& watch, const MeshingRpcs::Answer& answer) {
    const Status open = watch.admit();
    const Status answered = open ? service::guarded([&] { return answer(watch.caller()); }) : open;
    const grpc::Status status = answered ? grpc::Status() : wire::to_status(answered.error());
    watch.finished(status);
    reactor->Finish(status);
}

Status create_session(service::MeshingService& service, const service::Caller& caller, const grpc::CallbackServerContext& context,
                      const v1::CreateSessionRequest& request, v1::Session& response) {
    const Expected<std::optional<MeshFormat>> format = wire::from_proto(request.format());
    if (!format) return format.error();
    const Expected<std::optional<RepairOptions>> repair = wire::repair_of(request);
    if (!repair) return repair.error();
    const Expected<std::optional<LengthUnit>> unit = wire::from_proto(request.unit());
    if (!unit) return unit.error();
    const service::MeshSettings settings{*format, request.weld(), *repair, *unit};
    const Expected<service::SessionSnapshot> created =
        request.mesh().empty()
            ? service.create_session(caller)
            : service.create_session(std::as_bytes(std::span(request.mesh())), settings, caller, wanted_by(context));
    if (!created) return created.error();
    response = to_proto(*created);
    return Done{};
}

/// A use of the session, as whatever finds it.
Status show_session(service::MeshingService& service, const service::Caller& caller, const std::string& id,
                    v1::Session& response) {
    const Expected<service::SessionSnapshot> session = service.snapshot(id, caller);
    if (!session) return session.error();
    response = to_proto(*session);
    return Done{};
}

Status keep_alive(service::MeshingService& service, const service::Caller& caller, const std::string& id, v1::Session& response) {
    const Expected<service::SessionSnapshot> session = service.keep_alive(id, caller);
    if (!session) return session.error();
    response = to_proto(*session);
    return Done{};
}

Status list_sessions(service::MeshingService& service, const service::Caller& caller, const v1::ListSessionsRequest& request,
                     v1::ListSessionsResponse& response) {
    Expected<service::SessionPage> page = service.sessions().list(request.page_size(), request.page_token(), caller.owner);
    if (!page) return page.error();
    for (const service::SessionSnapshot& session : page->sessions) {
        v1::Session& entry = *response.add_sessions() = to_proto(session);
        shorten_groups(entry);
    }
    response.set_next_page_token(std::move(page->next_page_token));
    return Done{};
}

Status get_quality(service::MeshingService& service, const service::Caller& caller, const grpc::CallbackServerContext& context,
                   const v1::GetQualityRequest& request, v1::Quality& response) {
    const std::uint32_t worst = request.worst() == 0 ? kDefaultWorst : request.worst();
    if (worst > kMostWorst) {
        return Error{Cause::kInvalidOption,
                     "worst is " + std::to_string(worst) + "; accepted are 0 to " + std::to_string(kMostWorst), "worst"};
    }
    const Expected<std::optional<QualityProfile>> profile = wire::from_proto(request.profile());
    if (!profile) return profile.error();
    const Expected<service::SessionSnapshot> session = service.snapshot(request.session(), caller);
    if (!session) return session.error();
    const Expected<service::PickedMesh> picked = service::PickedMesh::pick(*session, {request.representation(), request.faces()});
    if (!picked) return picked.error();
    const Expected<service::OpenedMesh> opened = picked->open();
    if (!opened) return opened.error();
    const Expected<service::MemoryBudget::Share> room =
        service.memory().borrow(service::memory_to_measure(opened->ref.faces), "measuring the quality of this mesh");
    if (!room) return room.error();
    if (context.IsCancelled()) return nobody_waits();
    const Quality quality = opened->quality();
    if (context.IsCancelled()) return nobody_waits();
    response = wire::to_proto(quality, worst_faces(*opened->mesh, worst));
    response.set_unit(wire::to_proto(picked->unit()));
    if (*profile) *response.mutable_profile() = wire::to_proto(check_profile(*opened->mesh, **profile, worst));
    return Done{};
}

Status list_features(service::MeshingService& service, const service::Caller& caller, const v1::ListFeaturesRequest& request,
                     v1::ListFeaturesResponse& response) {
    const auto found = service::list_features_of(service, request.session(), wire::search_of(request), caller);
    if (!found) return found.error();
    response = wire::to_proto(found->features, found->unit);
    return Done{};
}

Status remove_features(service::MeshingService& service, const service::Caller& caller,
                       const grpc::CallbackServerContext& context, const v1::RemoveFeaturesRequest& request,
                       v1::RemoveFeaturesResponse& response) {
    const Expected<FeatureRemoval> removal = wire::from_proto(request);
    if (!removal) return removal.error();
    const auto done = service::remove_features_of(service, request.session(), *removal, wanted_by(context), caller);
    if (!done) return done.error();
    response = wire::to_proto(done->made, done->source->report);
    return Done{};
}

}  // namespace

grpc::ServerUnaryReactor* MeshingRpcs::answer_now(Context* context, const RpcWatch& watch, const Answer& answer) {
    grpc::ServerUnaryReactor* const reactor = context->DefaultReactor();
    finish(reactor, watch, answer);
    return reactor;
}

grpc::ServerUnaryReactor* MeshingRpcs::answer_later(Context* context, const RpcWatch& watch, Submit submit, Answer answer,
                                                    WhenLeft when_left) {
    grpc::ServerUnaryReactor* const reactor = context->DefaultReactor();
    const auto work = [context, reactor, watch, when_left, answer = std::move(answer)] {
        const bool drop = when_left == WhenLeft::kDrop && context->IsCancelled();
        finish(reactor, watch, drop ? Answer([](const service::Caller& /*any*/) { return Status(nobody_waits()); }) : answer);
    };
    const bool taken = (service_.*submit)(work);
    if (!taken)
        finish(reactor, watch, [](const service::Caller& /*any*/) -> Status {
            return Error{Cause::kUnavailable, "the server is shutting down", ""};
        });
    return reactor;
}

template <class Source, class Request>
auto* MeshingRpcs::stream(Context& context, const char* method, const Request& request) {
    using Message = typename Source::Message;
    return PullStream<Message>::open(
        RpcWatch(ledger_, context, method, request.session()),
        [&](const service::Caller& caller, const Wake& wake) { return Source::make(service_, caller, request, wake); });
}

grpc::ServerUnaryReactor* MeshingRpcs::CreateSession(Context* context, const v1::CreateSessionRequest* request,
                                                     v1::Session* response) {
    const RpcWatch watch(ledger_, *context, "CreateSession", "");
    return answer_later(context, watch, &service::MeshingService::intake,
                        [this, watch, context, request, response](const service::Caller& caller) {
                            Status created = create_session(service_, caller, *context, *request, *response);
                            watch.set_session(response->id());
                            return created;
                        });
}

grpc::ServerReadReactor<v1::UploadMeshRequest>* MeshingRpcs::UploadMesh(Context* context, v1::Session* response) {
    return new UploadStream(service_, RpcWatch(ledger_, *context, "UploadMesh", ""), response, patience_);
}

grpc::ServerUnaryReactor* MeshingRpcs::GetSession(Context* context, const v1::GetSessionRequest* request, v1::Session* response) {
    return answer_now(context, RpcWatch(ledger_, *context, "GetSession", request->session()),
                      [this, request, response](const service::Caller& caller) {
                          return show_session(service_, caller, request->session(), *response);
                      });
}

grpc::ServerUnaryReactor* MeshingRpcs::KeepAlive(Context* context, const v1::KeepAliveRequest* request, v1::Session* response) {
    return answer_later(context, RpcWatch(ledger_, *context, "KeepAlive", request->session()),
                        &service::MeshingService::disk_errand, [this, request, response](const service::Caller& caller) {
                            return keep_alive(service_, caller, request->session(), *response);
                        });
}

grpc::ServerUnaryReactor* MeshingRpcs::ListSessions(Context* context, const v1::ListSessionsRequest* request,
                                                    v1::ListSessionsResponse* response) {
    return answer_later(context, RpcWatch(ledger_, *context, "ListSessions", ""), &service::MeshingService::errand,
                        [this, request, response](const service::Caller& caller) {
                            return list_sessions(service_, caller, *request, *response);
                        });
}

grpc::ServerUnaryReactor* MeshingRpcs::DeleteSession(Context* context, const v1::DeleteSessionRequest* request,
                                                     google::protobuf::Empty* /*response*/) {
    return answer_later(
        context, RpcWatch(ledger_, *context, "DeleteSession", request->session()), &service::MeshingService::disk_errand,
        [this, request](const service::Caller& caller) { return service_.sessions().remove(request->session(), caller.owner); },
        WhenLeft::kDo);  // a page that is closed says so as the last thing
}

MeshingRpcs::EventReactor* MeshingRpcs::Improve(Context* context, const v1::ImproveRequest* request) {
    return stream<MethodSource>(*context, "Improve", *request);
}

MeshingRpcs::EventReactor* MeshingRpcs::Control(Context* context, const v1::ControlRequest* request) {
    return stream<MethodSource>(*context, "Control", *request);
}

MeshingRpcs::EventReactor* MeshingRpcs::SetResolution(Context* context, const v1::SetResolutionRequest* request) {
    return stream<LevelSource>(*context, "SetResolution", *request);
}

grpc::ServerWriteReactor<v1::MeshChunk>* MeshingRpcs::DownloadMesh(Context* context, const v1::DownloadMeshRequest* request) {
    const bool describe = context->client_metadata().count(wire::kDescribeFileKey) > 0;
    const DownloadSource::Want want = describe ? DownloadSource::Want::kDescription : DownloadSource::Want::kFile;
    return PullStream<v1::MeshChunk>::open(RpcWatch(ledger_, *context, "DownloadMesh", request->session()),
                                           [&](const service::Caller& caller, const Wake& wake) {
                                               return DownloadSource::make(service_, shelf_, caller, *request, want, wake);
                                           });
}

grpc::ServerUnaryReactor* MeshingRpcs::GetQuality(Context* context, const v1::GetQualityRequest* request, v1::Quality* response) {
    return answer_later(context, RpcWatch(ledger_, *context, "GetQuality", request->session()), &service::MeshingService::errand,
                        [this, context, request, response](const service::Caller& caller) {
                            return get_quality(service_, caller, *context, *request, *response);
                        });
}

grpc::ServerUnaryReactor* MeshingRpcs::ListFeatures(Context* context, const v1::ListFeaturesRequest* request,
                                                    v1::ListFeaturesResponse* response) {
    return answer_later(context, RpcWatch(ledger_, *context, "ListFeatures", request->session()),
                        &service::MeshingService::errand, [this, request, response](const service::Caller& caller) {
                            return list_features(service_, caller, *request, *response);
                        });
}

grpc::ServerUnaryReactor* MeshingRpcs::RemoveFeatures(Context* context, const v1::RemoveFeaturesRequest* request,
                                                      v1::RemoveFeaturesResponse* response) {
    return answer_later(context, RpcWatch(ledger_, *context, "RemoveFeatures", request->session()),
                        &service::MeshingService::intake, [this, context, request, response](const service::Caller& caller) {
                            return remove_features(service_, caller, *context, *request, *response);
                        });
}

}  // namespace vsplit::rpc
