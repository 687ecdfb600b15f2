#pragma once

#include <functional>
#include <memory>
#include <string_view>

#include "grpc/file_shelf.h"
#include "grpc/rpc_ledger.h"
#include "service/meshing_service.h"
#include "service/patience.h"
#include "vsplit/base/expected.h"
#include "vsplit/v1/meshing.grpc.pb.h"

namespace vsplit::rpc {

/// The rpcs of vsplit.v1.Meshing, as the proto describes them, on top of the service. Nothing heavy is done on gRPC's threads.
class MeshingRpcs final : public v1::Meshing::CallbackService {
public:
    /// Service and ledger must outlive the rpcs. \param patience with uploads
    MeshingRpcs(service::MeshingService& service, RpcLedger& ledger, const ShelfLimits& shelf, const service::Patience& patience)
        : service_(service), ledger_(ledger), shelf_(std::make_shared<FileShelf>(shelf)), patience_(patience) {}

    using Context = grpc::CallbackServerContext;
    using UnaryReactor = grpc::ServerUnaryReactor;
    using EventReactor = grpc::ServerWriteReactor<v1::ProgressiveEvent>;

    UnaryReactor* CreateSession(Context* context, const v1::CreateSessionRequest* request, v1::Session* response) override;
    grpc::ServerReadReactor<v1::UploadMeshRequest>* UploadMesh(Context* context, v1::Session* response) override;
    UnaryReactor* GetSession(Context* context, const v1::GetSessionRequest* request, v1::Session* response) override;
    UnaryReactor* ListSessions(Context* context, const v1::ListSessionsRequest* request,
                               v1::ListSessionsResponse* response) override;
    UnaryReactor* KeepAlive(Context* context, const v1::KeepAliveRequest* request, v1::Session* response) override;
    UnaryReactor* DeleteSession(Context* context, const v1::DeleteSessionRequest* request,
                                google::protobuf::Empty* response) override;
    EventReactor* Improve(Context* context, const v1::ImproveRequest* request) override;
    EventReactor* Control(Context* context, const v1::ControlRequest* request) override;
    EventReactor* SetResolution(Context* context, const v1::SetResolutionRequest* request) override;
    grpc::ServerWriteReactor<v1::MeshChunk>* DownloadMesh(Context* context, const v1::DownloadMeshRequest* request) override;
    UnaryReactor* GetQuality(Context* context, const v1::GetQualityRequest* request, v1::Quality* response) override;
    UnaryReactor* ListFeatures(Context* context, const v1::ListFeaturesRequest* request,
                               v1::ListFeaturesResponse* response) override;
    UnaryReactor* RemoveFeatures(Context* context, const v1::RemoveFeaturesRequest* request,
                                 v1::RemoveFeaturesResponse* response) override;

    using Answer = std::function<Status(const service::Caller& caller)>;

private:
    UnaryReactor* answer_now(Context* context, const RpcWatch& watch, const Answer& answer);
    /// What becomes of a call that nobody waits for any more when its turn comes.
    enum class WhenLeft { kDrop, kDo };

    /// On a thread of the pool that `submit` stands for.
    using Submit = bool (service::MeshingService::*)(service::WorkerPool::Task);
    UnaryReactor* answer_later(Context* context, const RpcWatch& watch, Submit submit, Answer answer,
                               WhenLeft when_left = WhenLeft::kDrop);

    template <class Source, class Request>
    auto* stream(Context& context, const char* method, const Request& request);

    service::MeshingService& service_;
    RpcLedger& ledger_;
    const std::shared_ptr<FileShelf> shelf_;
    const service::Patience patience_;
};

}  // namespace vsplit::rpc
