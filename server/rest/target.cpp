#include "rest/target.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

#include "rest/accept.h"
#include "rest/percent.h"

namespace vsplit::rest {
namespace {

constexpr std::size_t kMostParameters = 1000;

Error malformed(std::string message) { return {Cause::kMalformedInput, std::move(message), ""}; }

// What follows scheme and host, which proxies and some clients send.
std::string_view without_origin(std::string_view text) {
    for (const std::string_view scheme : {"http://", "https://"}) {
        if (!same_token(text.substr(0, scheme.size()), scheme)) continue;
        const std::size_t path = text.find_first_of("/?", scheme.size());
        return path == std::string_view::npos ? std::string_view("/") : text.substr(path);
    }
    return text;
}

std::optional<std::string> decode_form(std::string_view text) {
    std::string spaced(text);
    std::replace(spaced.begin(), spaced.end(), '+', ' ');
    return percent_decode(spaced);
}

Expected<std::vector<QueryParameter>> parse_query(std::string_view text) {
    std::vector<QueryParameter> parameters;
    while (!text.empty()) {
        const std::string_view pair = text.substr(0, text.find('&'));
        text.remove_prefix(std::min(text.size(), pair.size() + 1));
        if (pair.empty()) continue;
        if (parameters.size() == kMostParameters) return malformed("more than 1000 query parameters");
        const std::size_t equals = std::min(pair.find('='), pair.size());
        std::optional<std::string> name = decode_form(pair.substr(0, equals));
        std::optional<std::string> value = decode_form(pair.substr(std::min(pair.size(), equals + 1)));
        if (!name || !value) return malformed("a % in the query is not followed by two hexadecimal digits");
        parameters.push_back({*std::move(name), *std::move(value)});
    }
    return parameters;
}

}  // namespace

Expected<Target> parse_target(std::string_view text) {
    const std::string_view local = without_origin(text.substr(0, text.find('#')));
    const std::size_t mark = std::min(local.find('?'), local.size());
    Target target{std::string(local.substr(0, mark)), {}};
    if (target.path.empty() && mark != local.size()) target.path = "/";
    if (target.path.empty() || target.path.front() != '/') {
        return malformed("the target of the request is no path; accepted is /path or /path?query");
    }
    Expected<std::vector<QueryParameter>> query = parse_query(local.substr(std::min(local.size(), mark + 1)));
    if (!query) return query.error();
    target.query = *std::move(query);
    return target;
}

}  // namespace vsplit::rest
