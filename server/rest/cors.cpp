#include "rest/cors.h"

#include <algorithm>

#include "rest/accept.h"

namespace vsplit::rest {

CorsAnswer check_origin(std::string_view origin, std::string_view host, std::span<const std::string> allowed) {
    if (origin.empty()) return {};
    const std::size_t scheme = origin.find("://");
    const bool own = scheme != std::string_view::npos && same_token(origin.substr(scheme + 3), host);
    if (own) return {};
    const bool any = std::find(allowed.begin(), allowed.end(), "*") != allowed.end();
    const bool named = std::find(allowed.begin(), allowed.end(), origin) != allowed.end();
    if (!any && !named) return {true, {}};
    return {false,
            {{"Access-Control-Allow-Origin", any ? "*" : std::string(origin)},
             {"Access-Control-Expose-Headers", "Content-Disposition, Content-Range, ETag, Retry-After"},
             {"Vary", "Origin"}}};
}

HeaderFields preflight_fields(std::string_view allowed_methods) {
    return {{"Access-Control-Allow-Methods", std::string(allowed_methods)},
            {"Access-Control-Allow-Headers", "Accept, Authorization, Content-Type, If-Match, If-None-Match, If-Range, Range"},
            {"Access-Control-Max-Age", "600"}};
}

}  // namespace vsplit::rest
