#pragma once

#include <span>
#include <string>
#include <string_view>

#include "rest/header_fields.h"

namespace vsplit::rest {

/// What pages of other origins may do. By default nothing: not only may they not read answers, which browsers see to, but a
/// request from one is refused, as it could make sessions and start methods on a server that trusts who can reach it.
struct CorsAnswer {
    bool refused = false;
    HeaderFields fields;  ///< for the answer
};

/// `origin` and `host` are the request's header fields; `allowed` are origins ("https://example.org"), or "*" for any. A page
/// that the server itself served is no other origin. O(allowed).
[[nodiscard]] CorsAnswer check_origin(std::string_view origin, std::string_view host, std::span<const std::string> allowed);

/// Whether a Host field names this machine: by an address, as localhost, or as the host of an allowed origin. Who points the name
/// of a page of theirs at this machine ("DNS rebinding") has the browser take it for the server's own page; the name tells.
/// Empty, which no browser sends, is fine. O(allowed).
[[nodiscard]] bool is_own_host(std::string_view host, std::span<const std::string> allowed);

/// The further fields of the answer to a preflight.
[[nodiscard]] HeaderFields preflight_fields(std::string_view allowed_methods);

}  // namespace vsplit::rest
