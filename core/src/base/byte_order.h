#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <type_traits>

namespace vsplit {

/// Reads a number stored in `order` at `from`, which need not be aligned.
template <class T>
[[nodiscard]] T load(const std::byte* from, std::endian order = std::endian::little) {
    static_assert(std::is_arithmetic_v<T>);
    std::array<std::byte, sizeof(T)> raw;
    std::memcpy(raw.data(), from, sizeof(T));
    if (order != std::endian::native) std::reverse(raw.begin(), raw.end());
    return std::bit_cast<T>(raw);
}

/// Writes `value` little-endian at `to` and returns the place behind it.
template <class T>
char* store(char* to, T value) {
    static_assert(std::is_arithmetic_v<T>);
    auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
    if (std::endian::native != std::endian::little) std::reverse(raw.begin(), raw.end());
    std::memcpy(to, raw.data(), sizeof(T));
    return to + sizeof(T);
}

}  // namespace vsplit
