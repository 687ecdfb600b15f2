#pragma once

#include <array>
#include <cstdio>
#include <string>

namespace vsplit {

/// A number as messages show it: six digits, e.g. "0.25" or "1e-07".
[[nodiscard]] inline std::string number_text(double value) {
    std::array<char, 32> text{};
    const int length = std::snprintf(text.data(), text.size(), "%.6g", value);
    return {text.data(), static_cast<std::size_t>(length)};
}

}  // namespace vsplit
