#pragma once

#include <string>
#include <string_view>

namespace vsplit::service {

/// A client's text as it may appear in a message: in quotes, at most 64 bytes of it, what is not printable ASCII as '?'.
[[nodiscard]] std::string quoted(std::string_view text);

}  // namespace vsplit::service
