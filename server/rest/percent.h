#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace vsplit::rest {

/// %XX of RFC 3986 made bytes; empty for a % without two hexadecimal digits. O(text).
[[nodiscard]] std::optional<std::string> percent_decode(std::string_view text);

}  // namespace vsplit::rest
