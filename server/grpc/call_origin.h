#pragma once

#include <grpcpp/grpcpp.h>

#include <string>

#include "wire/trace_context.h"

namespace vsplit::rpc {

/// What a call says of where it comes from.
struct CallOrigin {
    std::string authorization;
    std::string peer;          ///< address of the client, without its port
    std::string request_id;    ///< the client's own name for it, or a new one
    wire::TraceContext trace;  ///< the client's trace, or a new one, with a span of its own
    std::string parent_span;   ///< empty where the trace begins here
};

[[nodiscard]] CallOrigin origin_of(const grpc::ServerContextBase& context);

/// The address alone of gRPC's "ipv4:127.0.0.1:50051" or "ipv6:%5B::1%5D:50051".
[[nodiscard]] std::string address_of(const std::string& peer);

}  // namespace vsplit::rpc
