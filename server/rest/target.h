#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "vsplit/base/expected.h"

namespace vsplit::rest {

struct QueryParameter {
    std::string name;
    std::string value;
};

/// What a request asks for: the target of its first line.
struct Target {
    std::string path;                   ///< as it came, still encoded; begins with '/'
    std::vector<QueryParameter> query;  ///< decoded, in order
};

/// Takes "/path?query" and "http://host/path?query" apart. \return MALFORMED_INPUT for anything else, a % without two hexadecimal
/// digits, and more than 1000 parameters. O(text).
[[nodiscard]] Expected<Target> parse_target(std::string_view text);

}  // namespace vsplit::rest
