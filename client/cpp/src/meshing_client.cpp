#include "vsplit/client/meshing_client.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "backoff.h"
#include "call.h"
#include "connect.h"
#include "download.h"
#include "event_stream.h"
#include "upload.h"
#include "vsplit/v1/meshing.grpc.pb.h"

namespace vsplit::client {

struct MeshingClient::Impl {
    std::string target;
    std::unique_ptr<v1::Meshing::Stub> stub;

    /// A call with one answer: `method` is the stub's.
    template <class Response, class Request>
    Expected<Response> unary(grpc::Status (v1::Meshing::Stub::*method)(grpc::ClientContext*, const Request&, Response*),
                             const Request& request, const CallOptions& options) const {
        Call call(options);
        Response response;
        const grpc::Status status = ((*stub).*method)(call.context(), request, &response);
        if (!status.ok()) return call_error(status, target);
        return response;
    }

    /// The same for a call that is safe to make again, which it is while the server cannot be reached.
    template <class Response, class Request>
    Expected<Response> retried(grpc::Status (v1::Meshing::Stub::*method)(grpc::ClientContext*, const Request&, Response*),
                               const Request& request, const CallOptions& options) const {
        using Clock = std::chrono::steady_clock;
        const Clock::time_point begin = Clock::now();
        Backoff backoff(options.retry, options.stop);
        for (CallOptions once = options;;) {
            Expected<Response> answer = unary(method, request, once);
            if (answer || answer.error().cause != Cause::kUnavailable || !backoff.again()) return answer;
            if (!options.deadline) continue;
            const auto spent = std::chrono::ceil<std::chrono::milliseconds>(Clock::now() - begin);
            once.deadline = std::max(*options.deadline - spent, std::chrono::milliseconds(0));
        }
    }

    /// A call that streams events: `method` is the stub's.
    template <class Request>
    Expected<v1::Representation> stream(std::unique_ptr<grpc::ClientReader<v1::ProgressiveEvent>> (v1::Meshing::Stub::*method)(
                                            grpc::ClientContext*, const Request&),
                                        const Request& request, const EventHandlers& handlers, const CallOptions& options) const {
        Call call(options);
        const auto reader = ((*stub).*method)(call.context(), request);
        EventStream events(handlers);
        Status taken = Done{};
        while (taken) {
            v1::ProgressiveEvent event;
            if (!reader->Read(&event)) break;
            taken = events.take(std::move(event));
        }
        if (!taken) call.cancel();
        const grpc::Status status = reader->Finish();
        if (!taken) return taken.error();
        if (!status.ok()) return call_error(status, target);
        return events.finish();
    }
};

MeshingClient::MeshingClient(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
MeshingClient::MeshingClient(MeshingClient&&) noexcept = default;
MeshingClient& MeshingClient::operator=(MeshingClient&&) noexcept = default;
MeshingClient::~MeshingClient() = default;

Expected<MeshingClient> MeshingClient::connect(const std::string& target, const ConnectOptions& options) {
    Expected<std::shared_ptr<grpc::Channel>> channel = open_channel(target, options);
    if (!channel) return channel.error();
    auto impl = std::make_unique<Impl>();
    impl->target = target;
    impl->stub = v1::Meshing::NewStub(*channel);
    return MeshingClient(std::move(impl));
}

Expected<v1::Session> MeshingClient::create_session(const CallOptions& call) {
    return impl_->unary(&v1::Meshing::Stub::CreateSession, v1::CreateSessionRequest(), call);
}

Expected<v1::Session> MeshingClient::upload_mesh(const std::string& session, const std::filesystem::path& file,
                                                 const UploadOptions& options, const CallOptions& call) {
    return upload_file({*impl_->stub, impl_->target, session}, file, options, call);
}

Expected<v1::Session> MeshingClient::upload_mesh(const std::string& session, std::span<const std::byte> bytes,
                                                 const UploadOptions& options, const CallOptions& call) {
    return upload_bytes({*impl_->stub, impl_->target, session}, bytes, options, call);
}

Expected<v1::Session> MeshingClient::get_session(const std::string& session, const CallOptions& call) {
    v1::GetSessionRequest request;
    request.set_session(session);
    return impl_->retried(&v1::Meshing::Stub::GetSession, request, call);
}

Expected<v1::ListSessionsResponse> MeshingClient::list_sessions(const v1::ListSessionsRequest& request, const CallOptions& call) {
    return impl_->retried(&v1::Meshing::Stub::ListSessions, request, call);
}

Expected<v1::Session> MeshingClient::keep_alive(const std::string& session, const CallOptions& call) {
    v1::KeepAliveRequest request;
    request.set_session(session);
    return impl_->retried(&v1::Meshing::Stub::KeepAlive, request, call);
}

Status MeshingClient::delete_session(const std::string& session, const CallOptions& call) {
    v1::DeleteSessionRequest request;
    request.set_session(session);
    const auto deleted = impl_->retried(&v1::Meshing::Stub::DeleteSession, request, call);
    if (!deleted) return deleted.error();
    return Done{};
}

Expected<v1::Representation> MeshingClient::improve(const v1::ImproveRequest& request, const EventHandlers& handlers,
                                                    const CallOptions& call) {
    return impl_->stream(&v1::Meshing::Stub::Improve, request, handlers, call);
}

Expected<v1::Representation> MeshingClient::control(const v1::ControlRequest& request, const EventHandlers& handlers,
                                                    const CallOptions& call) {
    return impl_->stream(&v1::Meshing::Stub::Control, request, handlers, call);
}

Expected<v1::Representation> MeshingClient::set_resolution(const v1::SetResolutionRequest& request, const EventHandlers& handlers,
                                                           const CallOptions& call) {
    return impl_->stream(&v1::Meshing::Stub::SetResolution, request, handlers, call);
}

Expected<std::uint32_t> MeshingClient::download_mesh(const v1::DownloadMeshRequest& request, const std::filesystem::path& file,
                                                     const CallOptions& call) {
    return download_file(*impl_->stub, impl_->target, request, file, call);
}

Expected<v1::Quality> MeshingClient::get_quality(const v1::GetQualityRequest& request, const CallOptions& call) {
    return impl_->retried(&v1::Meshing::Stub::GetQuality, request, call);
}

Expected<v1::ListFeaturesResponse> MeshingClient::list_features(const v1::ListFeaturesRequest& request, const CallOptions& call) {
    return impl_->retried(&v1::Meshing::Stub::ListFeatures, request, call);
}

Expected<v1::RemoveFeaturesResponse> MeshingClient::remove_features(const v1::RemoveFeaturesRequest& request,
                                                                    const CallOptions& call) {
    return impl_->unary(&v1::Meshing::Stub::RemoveFeatures, request, call);
}

}  // namespace vsplit::client
