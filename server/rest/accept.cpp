#include "rest/accept.h"

#include <algorithm>
#include <charconv>
#include <system_error>

namespace vsplit::rest {
namespace {

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

std::string_view trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t");
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

double weight(std::string_view parameters) {
    while (!parameters.empty()) {
        const std::string_view parameter = take(parameters, ';');
        if (parameter.size() < 2 || lower(parameter[0]) != 'q' || parameter[1] != '=') continue;
        double q = 0;
        const auto [end, failed] = std::from_chars(parameter.data() + 2, parameter.data() + parameter.size(), q);
        return failed == std::errc() && end == parameter.data() + parameter.size() && q >= 0 && q <= 1 ? q : 0;
    }
    return 1;
}

// 3 for the type itself, 2 for "type/*", 1 for "*/*", 0 for another.
int fit(std::string_view range, std::string_view type) {
    if (same_token(range, type)) return 3;
    if (range == "*/*") return 1;
    const std::size_t slash = range.find('/');
    const bool family = slash != std::string_view::npos && range.substr(slash) == "/*" &&
                        same_token(range.substr(0, slash), type.substr(0, type.find('/')));
    return family ? 2 : 0;
}

// The closest range decides, whatever the others weigh.
double weight_of(std::string_view accept, std::string_view type) {
    int best = 0;
    double q = 0;
    while (!accept.empty()) {
        std::string_view item = take(accept, ',');
        const std::string_view range = take(item, ';');
        const int closeness = fit(range, type);
        if (closeness <= best) continue;
        best = closeness;
        q = weight(item);
    }
    return q;
}

}  // namespace

std::string_view take(std::string_view& text, char separator) {
    const std::string_view item = text.substr(0, text.find(separator));
    text.remove_prefix(std::min(text.size(), item.size() + 1));
    return trimmed(item);
}

bool same_token(std::string_view a, std::string_view b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) { return lower(x) == lower(y); });
}

std::string_view media_type(std::string_view content_type) { return take(content_type, ';'); }

std::optional<std::size_t> choose_media_type(std::string_view accept, std::span<const std::string_view> offers) {
    if (trimmed(accept).empty()) return offers.empty() ? std::nullopt : std::optional<std::size_t>(0);
    std::optional<std::size_t> best;
    double most = 0;
    for (std::size_t i = 0; i < offers.size(); ++i) {
        const double q = weight_of(accept, offers[i]);
        if (q > most) {
            most = q;
            best = i;
        }
    }
    return best;
}

bool accepts_encoding(std::string_view accept_encoding, std::string_view coding) {
    while (!accept_encoding.empty()) {
        std::string_view item = take(accept_encoding, ',');
        if (same_token(take(item, ';'), coding)) return weight(item) > 0;
    }
    return false;
}

}  // namespace vsplit::rest
