#pragma once

#include <grpcpp/grpcpp.h>

#include <future>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "grpc/grpc_server.h"
#include "service/meshing_service.h"
#include "vsplit/v1/meshing.grpc.pb.h"

namespace vsplit::test {

/// Two workers, one thread a method: the same on every machine.
[[nodiscard]] service::ServiceOptions small_server();

/// A server in this process, on a free port of the loopback, and a connection to it.
class TestServer {
public:
    explicit TestServer(const service::ServiceOptions& options = small_server(), rpc::GrpcExtras extras = {});
    ~TestServer();

    /// Connected when first asked for: a server that counts its connections may be left alone.
    [[nodiscard]] v1::Meshing::Stub& stub();
    [[nodiscard]] service::MeshingService& service() { return service_; }
    [[nodiscard]] std::unique_ptr<v1::Meshing::Stub> connect() const;
    [[nodiscard]] rpc::GrpcServer& server() { return *server_; }
    [[nodiscard]] int port() const { return server_->port(); }

    /// Names and causes of the rpcs that ended so far, e.g. "Improve CANCELLED".
    [[nodiscard]] std::vector<std::string> finished() const;

private:
    void note(const rpc::RpcRecord& record);

    mutable std::mutex mutex_;
    std::vector<std::string> finished_;
    service::MeshingService service_;
    std::unique_ptr<rpc::GrpcServer> server_;
    std::once_flag connected_;
    std::unique_ptr<v1::Meshing::Stub> stub_;
};

/// While it lives no errand of a reader begins: no file is written, no level rebuilt, no quality measured.
class BlockedErrands {
public:
    explicit BlockedErrands(service::MeshingService& service);
    ~BlockedErrands() { open_.set_value(); }
    BlockedErrands(const BlockedErrands&) = delete;
    BlockedErrands& operator=(const BlockedErrands&) = delete;

private:
    std::promise<void> open_;
};

}  // namespace vsplit::test
