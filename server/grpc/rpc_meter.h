#pragma once

#include <grpcpp/support/server_interceptor.h>
#include <grpcpp/support/status.h>

#include <chrono>
#include <cstddef>
#include <memory>
#include <string_view>

namespace vsplit::rpc {

/// Counts rpcs, whichever door they came by. All calls from gRPC's threads; none may block.
class RpcMeter {
public:
    RpcMeter() = default;
    virtual ~RpcMeter() = default;
    RpcMeter(const RpcMeter&) = delete;
    RpcMeter& operator=(const RpcMeter&) = delete;

    /// `method` is the text of a MethodName.
    virtual void rpc_began(std::string_view method) = 0;
    virtual void rpc_ended(std::string_view method, grpc::StatusCode code, std::chrono::steady_clock::duration elapsed) = 0;

    /// A message of so many bytes came in, or goes out.
    virtual void message_in(std::size_t bytes) = 0;
    virtual void message_out(std::size_t bytes) = 0;
};

/// What tells `meter` of every rpc of a server. `meter` must outlive the server.
[[nodiscard]] std::unique_ptr<grpc::experimental::ServerInterceptorFactoryInterface> interceptor_of(RpcMeter& meter);

}  // namespace vsplit::rpc
