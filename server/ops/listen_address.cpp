#include "ops/listen_address.h"

#include <charconv>
#include <cstdint>
#include <system_error>

namespace vsplit::ops {
namespace {

bool is_port(std::string_view text) {
    std::uint16_t port = 0;
    const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), port);
    return failed == std::errc() && end == text.data() + text.size();
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

}  // namespace vsplit::ops
