#pragma once

#include <CLI/CLI.hpp>
#include <charconv>
#include <limits>
#include <sstream>
#include <string>
#include <system_error>
#include <type_traits>

namespace vsplit::ops {

/// Checks that an option's text is a number in [least, most], written in decimals. CLI11's own check takes NaN, wraps what is too
/// large, and reads 010 as eight.
template <class Number>
[[nodiscard]] CLI::Validator number_range(Number least, Number most) {
    std::ostringstream range;
    range << least << " to " << most;
    const std::string kind = std::is_integral_v<Number> ? "a whole number from " : "a number from ";
    const auto check = [least, most, accepted = kind + range.str()](const std::string& text) {
        Number value{};
        const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), value);
        const bool read = failed == std::errc() && end == text.data() + text.size();
        if (read && value >= least && value <= most) return std::string();  // NaN is in no range
        return "it is \"" + text + "\"; accepted is " + accepted;
    };
    return {check, range.str(), "number_range"};
}

/// As far as the type goes.
template <class Number>
[[nodiscard]] CLI::Validator number_from(Number least) {
    return number_range(least, std::numeric_limits<Number>::max());
}

/// 0, which is no limit, or what `range` takes.
[[nodiscard]] inline CLI::Validator zero_or(const CLI::Validator& range) {
    const auto check = [range, zero = number_range(0.0, 0.0)](const std::string& text) {
        const std::string wrong = zero(text).empty() ? std::string() : range(text);
        return wrong.empty() ? wrong : wrong + ", and 0";
    };
    return {check, "0 or " + range.get_description(), "zero_or"};
}

}  // namespace vsplit::ops
