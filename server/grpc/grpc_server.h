#pragma once

#include <grpcpp/grpcpp.h>

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "grpc/connection_door.h"
#include "grpc/live_calls.h"
#include "grpc/meshing_rpcs.h"
#include "grpc/rpc_ledger.h"
#include "grpc/rpc_meter.h"
#include "grpc/stranger_check.h"
#include "guard/gatekeeper.h"
#include "guard/tls_book.h"
#include "service/meshing_service.h"
#include "service/patience.h"
#include "vsplit/base/expected.h"

namespace vsplit::rpc {

/// What clients may use up.
struct GrpcLimits {
    std::size_t connections = 0;                          ///< at a time; 0: no limit
    std::size_t rpcs = 0;                                 ///< at a time; 0: no limit
    int message_bytes = 16 << 20;                         ///< of one message; larger meshes come by UploadMesh, in parts
    int streams = 1000;                                   ///< rpcs of one connection at a time; more wait at the client
    std::size_t message_memory = std::size_t{256} << 20;  ///< that messages on their way in take, of all connections together
};

/// How long connections live.
struct ConnectionLife {
    std::chrono::seconds keepalive{0};   ///< of silence, then a client is asked for a sign of life and cut off without; 0: never
    std::chrono::seconds age{0};         ///< then a client is told to connect anew when its rpcs are done; 0: never
    std::chrono::seconds handshake{20};  ///< that a client has for TLS and HTTP/2's first words, then it is cut off
};

/// What a server has beside the contract.
struct GrpcExtras {
    RpcObserver observer{};
    RpcMeter* meter = nullptr;               ///< counts every rpc; must outlive the server
    std::vector<grpc::Service*> services{};  ///< served too; must outlive the server
    guard::Gatekeeper* gate = nullptr;       ///< who may make rpcs of the contract; null: everybody; must outlive the server
    GrpcLimits limits{};
    ConnectionLife life{};
    std::shared_ptr<guard::TlsBook> tls{};          ///< null: plain
    std::function<void()> on_connection_refused{};  ///< of a connection over the limit
    service::Patience patience{};                   ///< with uploads
    ShelfLimits shelf{};                            ///< of files that are downloaded
};

/// The gRPC front door: vsplit.v1.Meshing, health (of the server and of that service) and reflection.
class GrpcServer {
public:
    /// Serves at `host`:`port` (0 for a free one) from now on. `service` must outlive the server. \return UNAVAILABLE when it
    /// cannot listen there, with the reason.
    [[nodiscard]] static Expected<std::unique_ptr<GrpcServer>> start(const std::string& host, const std::string& port,
                                                                     service::MeshingService& service, const GrpcExtras& extras);
    ~GrpcServer();
    GrpcServer(const GrpcServer&) = delete;
    GrpcServer& operator=(const GrpcServer&) = delete;

    [[nodiscard]] int port() const { return door_.port(); }

    /// A way to the same rpcs without a socket, for another door: what holds for one holds for the other.
    [[nodiscard]] std::shared_ptr<grpc::Channel> channel();

    /// Whether new rpcs are taken.
    [[nodiscard]] bool ready() const { return ledger_.admit().has_value(); }

    /// Says NOT_SERVING, takes no more rpcs, and gives those that run `grace` to end. Whether they did.
    bool drain(std::chrono::milliseconds grace);

    /// drain, and cancels the rest. Once.
    void shutdown(std::chrono::milliseconds grace);

private:
    GrpcServer(service::MeshingService& service, const GrpcExtras& extras);

    [[nodiscard]] Status serve(const GrpcExtras& extras);

    RpcLedger ledger_;
    LiveCalls live_;
    MeshingRpcs rpcs_;
    StrangerCheck strangers_;
    const std::shared_ptr<grpc::ServerCredentials> credentials_;  // outlive the server
    std::unique_ptr<grpc::Server> server_;
    std::unique_ptr<grpc::experimental::ExternalConnectionAcceptor> acceptor_;
    ConnectionDoor door_;
};

}  // namespace vsplit::rpc
