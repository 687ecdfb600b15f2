#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

namespace vsplit::rest {

/// Which of `offers` (media types, the one preferred by us first) an Accept header (RFC 9110 12.5.1) prefers; the first where
/// there is no header, none where it accepts none. What cannot be read in a header is passed over. O(header * offers).
[[nodiscard]] std::optional<std::size_t> choose_media_type(std::string_view accept, std::span<const std::string_view> offers);

/// Whether an Accept-Encoding header names the coding with a weight above 0. O(header).
[[nodiscard]] bool accepts_encoding(std::string_view accept_encoding, std::string_view coding);

/// The type of a Content-Type header without its parameters, as it came: compare by `same_token`.
[[nodiscard]] std::string_view media_type(std::string_view content_type);

/// Whether two names of media types, codings or tokens are the same: without regard to case.
[[nodiscard]] bool same_token(std::string_view a, std::string_view b);

/// Takes what stands in `text` before the next separator, or all, and the separator; without the blanks around it.
[[nodiscard]] std::string_view take(std::string_view& text, char separator);

}  // namespace vsplit::rest
