#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "vsplit/base/expected.h"

namespace vsplit::rest {

/// A part of a path that names a field of the request.
struct PathVariable {
    std::string field;  ///< dotted for a field of a field
    std::string value;  ///< decoded
};

/// A path template of google.api.http: "/v1/sessions/{session}:improve".
///
/// Segments are literals, "*" (one segment, not empty), "**" (all that follow, only as the last) and "{field}" or
/// "{field=segments}"; a verb may follow after a colon. "{field}" is "{field=*}".
class PathTemplate {
public:
    /// \return MALFORMED_INPUT for what is no template. O(text).
    [[nodiscard]] static Expected<PathTemplate> parse(std::string_view text);

    /// The variables of a path that fits, which is still encoded; empty for one that does not. Literals and verbs are compared as
    /// they stand: an encoded slash or colon separates nothing. O(path).
    [[nodiscard]] std::optional<std::vector<PathVariable>> match(std::string_view path) const;

    /// As OpenAPI writes it: the variables' names only.
    [[nodiscard]] std::string openapi_path() const;

    /// Names of the variables, in order.
    [[nodiscard]] std::vector<std::string> fields() const;

    /// How much of a path is told: of two templates that fit, the greater is meant.
    [[nodiscard]] std::size_t specificity() const;

private:
    enum class Kind { kLiteral, kOne, kRest };

    struct Segment {
        Kind kind = Kind::kLiteral;
        std::string literal;
    };

    // Segments [first, last) are the value of a field.
    struct Variable {
        std::string field;
        std::size_t first = 0;
        std::size_t last = 0;
    };

    [[nodiscard]] Status parse_segments(std::string_view text);
    [[nodiscard]] Status parse_segment(std::string_view text);
    [[nodiscard]] bool fits(const std::vector<std::string_view>& parts) const;
    [[nodiscard]] const Variable* variable_at(std::size_t segment) const;

    std::vector<Segment> segments_;
    std::vector<Variable> variables_;
    std::string verb_;
};

}  // namespace vsplit::rest
