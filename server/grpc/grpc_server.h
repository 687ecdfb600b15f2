#pragma once

#include <grpcpp/grpcpp.h>

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "grpc/meshing_rpcs.h"
#include "grpc/rpc_ledger.h"
#include "grpc/rpc_meter.h"
#include "service/meshing_service.h"
#include "vsplit/base/expected.h"

namespace vsplit::rpc {

/// What a server has beside the contract.
struct GrpcExtras {
    RpcObserver observer{};
    RpcMeter* meter = nullptr;               ///< counts every rpc; must outlive the server
    std::vector<grpc::Service*> services{};  ///< served too; must outlive the server
};

/// The gRPC front door: vsplit.v1.Meshing, health (of the server and of that service) and reflection.
class GrpcServer {
public:
    /// Largest message it takes; larger meshes come by UploadMesh, in parts.
    static constexpr int kMaxMessageBytes = 16 << 20;

    /// Serves at `address` ("host:port", port 0 for a free one) from now on. `service` must outlive the server.
    /// \return UNAVAILABLE when it cannot listen there.
    [[nodiscard]] static Expected<std::unique_ptr<GrpcServer>> start(const std::string& address, service::MeshingService& service,
                                                                     const GrpcExtras& extras);
    ~GrpcServer();
    GrpcServer(const GrpcServer&) = delete;
    GrpcServer& operator=(const GrpcServer&) = delete;

    [[nodiscard]] int port() const { return port_; }

    /// A way to the same rpcs without a socket, for another door: what holds for one holds for the other.
    [[nodiscard]] std::shared_ptr<grpc::Channel> channel();

    /// Whether new rpcs are taken.
    [[nodiscard]] bool ready() const { return ledger_.admit().has_value(); }

    /// Says NOT_SERVING, takes no more rpcs, and gives those that run `grace` to end.
    void drain(std::chrono::milliseconds grace);

    /// drain, and cancels the rest. Once.
    void shutdown(std::chrono::milliseconds grace);

private:
    GrpcServer(service::MeshingService& service, RpcObserver observer);

    [[nodiscard]] Status listen(const std::string& address, const GrpcExtras& extras);

    RpcLedger ledger_;
    MeshingRpcs rpcs_;
    std::unique_ptr<grpc::Server> server_;
    int port_ = 0;
};

}  // namespace vsplit::rpc
