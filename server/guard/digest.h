#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace vsplit::guard {

/// SHA-256 of some bytes.
using Digest = std::array<unsigned char, 32>;

/// O(bytes).
[[nodiscard]] Digest digest_of(std::string_view bytes);

/// Of `parts`, one after the other. O(bytes).
[[nodiscard]] Digest digest_of(std::span<const std::span<const std::byte>> parts);

/// As 64 hexadecimal digits, lower case.
[[nodiscard]] std::string hex_digits(const Digest& digest);

}  // namespace vsplit::guard
