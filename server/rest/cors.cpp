#include "rest/cors.h"

#include <algorithm>

#include "rest/accept.h"

namespace vsplit::rest {
namespace {

// The host and port of an origin; empty for what is none.
std::string_view authority_of(std::string_view origin) {
    const std::size_t scheme = origin.find("://");
    return scheme == std::string_view::npos ? std::string_view() : origin.substr(scheme + 3);
}

bool is_any(std::span<const std::string> allowed) { return std::find(allowed.begin(), allowed.end(), "*") != allowed.end(); }

// Names never look like that: their last part is not of digits alone.
bool is_address(std::string_view host) {
    return host.front() == '[' || host.find_first_not_of("0123456789.") == std::string_view::npos;
}

bool is_localhost(std::string_view host) {
    constexpr std::string_view kLocalhost = "localhost";
    if (host.size() < kLocalhost.size() || !same_token(host.substr(host.size() - kLocalhost.size()), kLocalhost)) return false;
    return host.size() == kLocalhost.size() || host[host.size() - kLocalhost.size() - 1] == '.';
}

}  // namespace

CorsAnswer check_origin(std::string_view origin, std::string_view host, std::span<const std::string> allowed) {
    if (origin.empty()) return {};
    const std::string_view authority = authority_of(origin);
    if (!authority.empty() && same_token(authority, host)) return {};
    const bool any = is_any(allowed);
    const bool named = std::find(allowed.begin(), allowed.end(), origin) != allowed.end();
    if (!any && !named) return {true, {}};
    return {
        false,
        {{"Access-Control-Allow-Origin", any ? "*" : std::string(origin)},
         {"Access-Control-Expose-Headers",
          "Accept-Ranges, Content-Disposition, Content-Range, ETag, Retry-After, WWW-Authenticate, X-Request-Id, traceparent"},
         {"Vary", "Origin"}}};
}

bool is_own_host(std::string_view host, std::span<const std::string> allowed) {
    if (host.empty() || is_any(allowed)) return true;
    const auto is_its = [host](const std::string& origin) { return same_token(authority_of(origin), host); };
    if (std::any_of(allowed.begin(), allowed.end(), is_its)) return true;
    const std::string_view name = host.front() == '[' ? host : host.substr(0, host.find(':'));
    return !name.empty() && (is_address(name) || is_localhost(name));
}

HeaderFields preflight_fields(std::string_view allowed_methods) {
    return {{"Access-Control-Allow-Methods", std::string(allowed_methods)},
            {"Access-Control-Allow-Headers",
             "Accept, Authorization, Content-Type, If-Match, If-None-Match, If-Range, Range, X-Request-Id, traceparent"},
            {"Access-Control-Max-Age", "600"}};
}

}  // namespace vsplit::rest
