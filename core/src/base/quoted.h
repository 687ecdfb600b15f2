#pragma once

#include <string>
#include <string_view>

namespace vsplit {

/// `text` in quotes, fit for a message whatever a file holds: printable ASCII, at most 40 characters of it.
[[nodiscard]] std::string quoted(std::string_view text);

}  // namespace vsplit
