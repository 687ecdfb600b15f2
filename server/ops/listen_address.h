#pragma once

#include <string>
#include <string_view>

#include "vsplit/base/expected.h"

namespace vsplit::ops {

/// Where to listen.
struct ListenAddress {
    std::string host;  ///< without the brackets of an IPv6 address
    std::string port;  ///< 0..65535

    /// "host:port", IPv6 in brackets.
    [[nodiscard]] std::string text(std::string_view actual_port) const;
};

/// `option` is where the text comes from, "listen" or "http". \return INVALID_OPTION for anything but "HOST:PORT" or
/// "[IPv6]:PORT".
[[nodiscard]] Expected<ListenAddress> parse_listen_address(std::string_view option, std::string_view text);

}  // namespace vsplit::ops
