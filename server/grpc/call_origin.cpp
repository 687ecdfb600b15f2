#include "grpc/call_origin.h"

#include <optional>
#include <string_view>

#include "service/random_id.h"

namespace vsplit::rpc {
namespace {

std::string_view metadata(const grpc::ServerContextBase& context, const char* name) {
    const auto found = context.client_metadata().find(name);
    if (found == context.client_metadata().end()) return {};
    return {found->second.data(), found->second.size()};
}

bool came_by_socket(std::string_view peer) {
    return peer.starts_with("ipv4:") || peer.starts_with("ipv6:") || peer.starts_with("unix:");
}

// Without the operating system's generator a call has no name, and no session would be made either.
std::string new_id() {
    const Expected<std::string> id = service::random_id();
    return id ? *id : std::string(32, '1');
}

}  // namespace

std::string address_of(const std::string& peer) {
    const std::size_t first = peer.find(':');
    const std::size_t last = peer.rfind(':');
    if (first == std::string::npos || last <= first) return peer;
    return peer.substr(first + 1, last - first - 1);
}

CallOrigin origin_of(const grpc::ServerContextBase& context) {
    CallOrigin origin;
    const std::string peer = context.peer();
    origin.authorization = metadata(context, "authorization");
    origin.peer = came_by_socket(peer) ? address_of(peer) : std::string(metadata(context, wire::kForwardedPeerKey));
    const std::string_view named = metadata(context, wire::kRequestIdKey);
    const std::string fresh = new_id();
    origin.request_id = wire::is_request_id(named) ? std::string(named) : fresh;
    const std::optional<wire::TraceContext> given = wire::parse_traceparent(metadata(context, wire::kTraceparentKey));
    constexpr std::size_t kSpanDigits = 16;
    origin.trace = given ? *given : wire::TraceContext{new_id(), "", "00"};
    origin.parent_span = origin.trace.span_id;
    origin.trace.span_id = fresh.substr(0, kSpanDigits);
    return origin;
}

}  // namespace vsplit::rpc
