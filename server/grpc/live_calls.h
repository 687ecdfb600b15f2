#pragma once

#include <grpc/grpc_security.h>
#include <grpcpp/support/server_interceptor.h>

#include <cstddef>
#include <memory>
#include <mutex>
#include <unordered_map>

#include "grpc/method_name.h"
#include "vsplit/base/expected.h"

namespace vsplit::rpc {

/// Counts the calls that came by a socket and take memory. HTTP/2's own limit forgets a stream that its client resets at once,
/// and gRPC reads on faster than it clears such calls away, at some 20 KB each: a client that opens and resets would take all
/// memory. So whoever has too many is refused at the header, which costs next to nothing. Thread-safe; must outlive the server.
class LiveCalls {
public:
    /// \param most rpcs at a time, of which those that are none of the contract have a tenth, but 100 at least; 0: no limit
    /// \param streams of one connection at a time
    LiveCalls(std::size_t most, std::size_t streams);

    /// Whether one more call may come by this connection. A call counts until gRPC has cleared it away, a moment after its client
    /// has the answer, so a connection and the whole have twice their limit, and 100. \return LIMIT_EXCEEDED. O(1).
    [[nodiscard]] Status admit(const grpc_auth_context* connection, MethodName::Kind kind) const;

    /// What keeps count, for the server's builder.
    [[nodiscard]] std::unique_ptr<grpc::experimental::ServerInterceptorFactoryInterface> counter();

private:
    class Call;
    class Factory;

    /// \return LIMIT_EXCEEDED for an open one that came while another one of the last places was taken.
    [[nodiscard]] Status begin(const grpc_auth_context* connection, MethodName::Kind kind);
    [[nodiscard]] Status admit_open(std::size_t calls) const;
    void end(const grpc_auth_context* connection, MethodName::Kind kind);

    const std::size_t most_;
    const std::size_t streams_;
    mutable std::mutex mutex_;
    std::unordered_map<const grpc_auth_context*, std::size_t> by_connection_;
    std::size_t all_ = 0;
    std::size_t open_ = 0;
};

}  // namespace vsplit::rpc
