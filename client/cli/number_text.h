#pragma once

#include <cstdint>
#include <string>

namespace vsplit::cli {

/// Digits in groups of three: 1234567 as "1,234,567".
[[nodiscard]] std::string grouped(std::uint64_t number);

/// "1 face", "1,200 faces".
[[nodiscard]] std::string counted(std::uint64_t number, const std::string& one, const std::string& many);

/// Six significant digits, e.g. "0.0125", "1.5e-07".
[[nodiscard]] std::string figure(double number);

/// `digits` after the point, e.g. "0.680".
[[nodiscard]] std::string fixed(double number, int digits);

/// `text` with blanks in front of it up to `width`.
[[nodiscard]] std::string right(const std::string& text, std::size_t width);

/// `text` with blanks after it up to `width`.
[[nodiscard]] std::string left(const std::string& text, std::size_t width);

}  // namespace vsplit::cli
