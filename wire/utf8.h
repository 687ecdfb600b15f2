#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace vsplit::wire {

/// `text` as valid UTF-8 of at most `max_bytes` bytes: every byte that is part of no valid sequence becomes '?', and what is too
/// long ends in "...". Messages may quote the bytes of a broken file; protobuf, JSON and terminals want UTF-8.
/// \pre max_bytes >= 3. O(text).
[[nodiscard]] std::string valid_utf8(std::string_view text, std::size_t max_bytes);

}  // namespace vsplit::wire
