#pragma once

#include <grpcpp/grpcpp.h>

#include <functional>
#include <string>
#include <string_view>

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

/// What a call's header says of a name in lower case; empty for what it does not.
using HeaderLookup = std::function<std::string_view(std::string_view name)>;

/// \param peer as gRPC has it; empty where it is not known
[[nodiscard]] CallOrigin origin_of(const HeaderLookup& header, const std::string& peer);

[[nodiscard]] CallOrigin origin_of(const grpc::ServerContextBase& context);

/// The address alone of gRPC's "ipv4:127.0.0.1:50051" or "ipv6:%5B::1%5D:50051".
[[nodiscard]] std::string address_of(const std::string& peer);

}  // namespace vsplit::rpc
