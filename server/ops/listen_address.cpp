#include "ops/listen_address.h"

#include <netdb.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdint>
#include <memory>
#include <system_error>

namespace vsplit::ops {
namespace {

using AddressList = std::unique_ptr<addrinfo, decltype(&freeaddrinfo)>;

bool is_port(std::string_view text) {
    std::uint16_t port = 0;
    const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), port);
    return failed == std::errc() && end == text.data() + text.size();
}

// The errno of listening at one address; 0 when it works.
int try_listening(const addrinfo& at) {
    const int descriptor = socket(at.ai_family, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (descriptor < 0) return errno;
    const int on = 1;
    setsockopt(descriptor, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
    const bool listening = bind(descriptor, at.ai_addr, at.ai_addrlen) == 0 && listen(descriptor, 1) == 0;
    const int failure = listening ? 0 : errno;
    close(descriptor);
    return failure;
}

}  // namespace

std::string ListenAddress::text(std::string_view actual_port) const {
    const bool is_ipv6 = host.find(':') != std::string::npos;
    return (is_ipv6 ? '[' + host + ']' : host) + ':' + std::string(actual_port);
}

Expected<ListenAddress> parse_listen_address(std::string_view option, std::string_view text) {
    const std::size_t colon = text.rfind(':');
    std::string_view host = text.substr(0, colon);
    if (host.size() > 2 && host.front() == '[' && host.back() == ']') {
        host = host.substr(1, host.size() - 2);
    } else if (host.find(':') != std::string_view::npos) {
        host = {};
    }
    if (colon == std::string_view::npos || host.empty() || !is_port(text.substr(colon + 1))) {
        return Error{Cause::kInvalidOption,
                     "--" + std::string(option) + " is \"" + std::string(text) +
                         "\"; accepted is HOST:PORT with a port of 0 to 65535, e.g. 127.0.0.1:50051 " + "or [::1]:50051",
                     std::string(option)};
    }
    return ListenAddress{std::string(host), std::string(text.substr(colon + 1))};
}

std::string why_not_listening(const ListenAddress& address) {
    addrinfo hints{};
    hints.ai_socktype = SOCK_STREAM;
    hints.ai_flags = AI_PASSIVE;
    addrinfo* found = nullptr;
    const int unknown = getaddrinfo(address.host.c_str(), address.port.c_str(), &hints, &found);
    if (unknown != 0) return gai_strerror(unknown);
    const AddressList list(found, &freeaddrinfo);
    for (const addrinfo* at = found; at != nullptr; at = at->ai_next) {
        if (const int failure = try_listening(*at); failure != 0) return std::generic_category().message(failure);
    }
    return "gRPC refused the address";
}

}  // namespace vsplit::ops
