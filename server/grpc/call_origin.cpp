#include "grpc/call_origin.h"

#include <optional>
#include <string_view>

#include "service/random_id.h"

namespace vsplit::rpc {
namespace {

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
    // [::1] comes as %5B::1%5D; HTTP's door knows the same client as ::1.
    constexpr std::string_view kOpen = "%5B", kClose = "%5D";
    std::string_view address = std::string_view(peer).substr(first + 1, last - first - 1);
    if (address.starts_with(kOpen) && address.ends_with(kClose)) {
        address.remove_prefix(kOpen.size());
        address.remove_suffix(kClose.size());
    }
    return std::string(address);
}

CallOrigin origin_of(const HeaderLookup& header, const std::string& peer) {
    CallOrigin origin;
    origin.authorization = header("authorization");
    origin.peer = peer;
    const std::string_view named = header(wire::kRequestIdKey);
    const std::string fresh = new_id();
    origin.request_id = wire::is_request_id(named) ? std::string(named) : fresh;
    const std::optional<wire::TraceContext> given = wire::parse_traceparent(header(wire::kTraceparentKey));
    constexpr std::size_t kSpanDigits = 16;
    origin.trace = given ? *given : wire::TraceContext{new_id(), "", "00"};
    origin.parent_span = origin.trace.span_id;
    origin.trace.span_id = fresh.substr(0, kSpanDigits);
    return origin;
}

CallOrigin origin_of(const grpc::ServerContextBase& context) {
    const HeaderLookup header = [&context](std::string_view name) -> std::string_view {
        const auto found = context.client_metadata().find(grpc::string_ref(name.data(), name.size()));
        if (found == context.client_metadata().end()) return {};
        return {found->second.data(), found->second.size()};
    };
    const std::string peer = context.peer();
    return origin_of(header, came_by_socket(peer) ? address_of(peer) : std::string(header(wire::kForwardedPeerKey)));
}

}  // namespace vsplit::rpc
