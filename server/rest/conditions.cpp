#include "rest/conditions.h"

#include <algorithm>
#include <cstddef>

namespace vsplit::rest {
namespace {

enum class Comparison { kStrong, kWeak };

// Whether a list of entity tags names this one. A tag may hold commas, so that its quotes are looked for.
bool names(std::string_view list, std::string_view etag, Comparison comparison) {
    constexpr std::string_view kBlank = " \t,";
    while (true) {
        list.remove_prefix(std::min(list.find_first_not_of(kBlank), list.size()));
        if (list.empty()) return false;
        if (list.front() == '*') return true;
        const bool weak = list.substr(0, 2) == "W/";
        if (weak) list.remove_prefix(2);
        const std::size_t end = list.empty() || list.front() != '"' ? std::string_view::npos : list.find('"', 1);
        if (end == std::string_view::npos) return false;  // no tag: what follows is none either
        if (list.substr(0, end + 1) == etag && !(weak && comparison == Comparison::kStrong)) return true;
        list.remove_prefix(end + 1);
    }
}

}  // namespace

Condition judge(std::string_view if_match, std::string_view if_none_match, std::string_view etag) {
    if (!if_match.empty() && !names(if_match, etag, Comparison::kStrong)) return Condition::kFailed;
    if (!if_none_match.empty() && names(if_none_match, etag, Comparison::kWeak)) return Condition::kNotModified;
    return Condition::kHolds;
}

bool range_holds(std::string_view if_range, std::string_view etag) { return if_range.empty() || if_range == etag; }

std::string entity_tag(std::string_view digest, std::string_view coding) {
    return '"' + std::string(digest) + (coding.empty() ? "" : "-") + std::string(coding) + '"';
}

}  // namespace vsplit::rest
