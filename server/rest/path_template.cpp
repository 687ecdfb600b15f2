#include "rest/path_template.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "rest/percent.h"

namespace vsplit::rest {
namespace {

Error no_template(std::string_view text) {
    return {Cause::kMalformedInput, "not a path template: \"" + std::string(text) + "\"", ""};
}

// Takes the text up to the next slash, or up to the end of a variable that holds slashes.
std::string_view take_segment(std::string_view& text) {
    const std::size_t slash = text.find('/');
    const std::size_t brace = text.find('{');
    std::size_t end = slash;
    if (brace < slash) end = text.find('/', std::min(text.find('}', brace), text.size()));
    const std::string_view segment = text.substr(0, end);
    text.remove_prefix(std::min(text.size(), segment.size() + 1));
    return segment;
}

std::vector<std::string_view> split(std::string_view path) {
    std::vector<std::string_view> parts;
    for (;;) {
        const std::size_t slash = path.find('/');
        parts.push_back(path.substr(0, slash));
        if (slash == std::string_view::npos) return parts;
        path.remove_prefix(slash + 1);
    }
}

// Where the verb's colon is; npos where there is none.
std::size_t verb_colon(std::string_view text) {
    const std::size_t colon = text.rfind(':');
    const std::size_t last = text.find_last_of("/}");
    return colon != std::string_view::npos && (last == std::string_view::npos || colon > last) ? colon : std::string_view::npos;
}

}  // namespace

Expected<PathTemplate> PathTemplate::parse(std::string_view text) {
    PathTemplate made;
    if (text.size() < 2 || text.front() != '/') return no_template(text);
    const std::size_t colon = verb_colon(text);
    if (colon != std::string_view::npos) made.verb_ = text.substr(colon + 1);
    if (colon != std::string_view::npos && made.verb_.empty()) return no_template(text);
    std::string_view rest = text.substr(1, colon == std::string_view::npos ? colon : colon - 1);
    if (rest.empty() || rest.back() == '/') return no_template(text);
    while (!rest.empty()) {
        const std::string_view segment = take_segment(rest);
        const bool variable = !segment.empty() && segment.front() == '{';
        const Status parsed = variable ? made.parse_segments(segment) : made.parse_segment(segment);
        if (!parsed) return no_template(text);
    }
    for (std::size_t i = 0; i + 1 < made.segments_.size(); ++i) {
        if (made.segments_[i].kind == Kind::kRest) return no_template(text);
    }
    return made;
}

Status PathTemplate::parse_segments(std::string_view text) {
    if (text.size() < 3 || text.back() != '}') return no_template(text);
    const std::string_view inside = text.substr(1, text.size() - 2);
    const std::size_t equals = inside.find('=');
    Variable variable{std::string(inside.substr(0, equals)), segments_.size(), 0};
    if (variable.field.empty() || variable.field.find_first_of("{}") != std::string::npos) return no_template(text);
    std::string_view pattern = equals == std::string_view::npos ? "*" : inside.substr(equals + 1);
    if (pattern.empty() || pattern.back() == '/') return no_template(text);
    while (!pattern.empty()) {
        if (Status parsed = parse_segment(take_segment(pattern)); !parsed) return parsed;
    }
    variable.last = segments_.size();
    variables_.push_back(std::move(variable));
    return Done{};
}

Status PathTemplate::parse_segment(std::string_view text) {
    if (text == "*") {
        segments_.push_back({Kind::kOne, ""});
    } else if (text == "**") {
        segments_.push_back({Kind::kRest, ""});
    } else if (text.empty() || text.find_first_of("{}*=") != std::string_view::npos) {
        return no_template(text);
    } else {
        segments_.push_back({Kind::kLiteral, std::string(text)});
    }
    return Done{};
}

bool PathTemplate::fits(const std::vector<std::string_view>& parts) const {
    const bool open = segments_.back().kind == Kind::kRest;
    if (open ? parts.size() + 1 < segments_.size() : parts.size() != segments_.size()) return false;
    for (std::size_t i = 0; i < segments_.size(); ++i) {
        if (segments_[i].kind == Kind::kLiteral && segments_[i].literal != parts[i]) return false;
        if (segments_[i].kind == Kind::kOne && parts[i].empty()) return false;
    }
    return true;
}

std::optional<std::vector<PathVariable>> PathTemplate::match(std::string_view path) const {
    if (path.empty() || path.front() != '/') return std::nullopt;
    const std::size_t colon = verb_colon(path);
    if (!verb_.empty()) {
        if (colon == std::string_view::npos || path.substr(colon + 1) != verb_) return std::nullopt;
        path = path.substr(0, colon);
    }
    const std::vector<std::string_view> parts = split(path.substr(1));
    if (!fits(parts)) return std::nullopt;
    std::vector<PathVariable> values;
    for (const Variable& variable : variables_) {
        const bool open = segments_[variable.last - 1].kind == Kind::kRest;
        std::string text;
        for (std::size_t i = variable.first; i < (open ? parts.size() : variable.last); ++i) {
            if (i > variable.first) text += '/';
            text += parts[i];
        }
        std::optional<std::string> decoded = percent_decode(text);
        if (!decoded) return std::nullopt;
        values.push_back({variable.field, *std::move(decoded)});
    }
    return values;
}

const PathTemplate::Variable* PathTemplate::variable_at(std::size_t segment) const {
    const auto found =
        std::find_if(variables_.begin(), variables_.end(), [segment](const Variable& v) { return v.first == segment; });
    return found == variables_.end() ? nullptr : &*found;
}

std::string PathTemplate::openapi_path() const {
    std::string text;
    for (std::size_t i = 0; i < segments_.size();) {
        const Variable* const variable = variable_at(i);
        if (variable != nullptr) {
            text += "/{" + variable->field + '}';
            i = variable->last;
            continue;
        }
        text += '/' + (segments_[i].kind == Kind::kLiteral ? segments_[i].literal : std::string("*"));
        ++i;
    }
    return verb_.empty() ? text : text + ':' + verb_;
}

std::vector<std::string> PathTemplate::fields() const {
    std::vector<std::string> names;
    names.reserve(variables_.size());
    for (const Variable& variable : variables_) names.push_back(variable.field);
    return names;
}

std::size_t PathTemplate::specificity() const {
    std::size_t told = verb_.empty() ? 0 : 1;
    for (const Segment& segment : segments_) told += segment.kind == Kind::kLiteral ? 2 : 0;
    return told;
}

}  // namespace vsplit::rest
