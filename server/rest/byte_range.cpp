#include "rest/byte_range.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "rest/accept.h"

namespace vsplit::rest {
namespace {

// Digits; a number that is too large for us is as large as we can say, and no file goes so far.
std::optional<std::uint64_t> number(std::string_view text) {
    constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max();
    if (text.empty()) return std::nullopt;
    std::uint64_t value = 0;
    for (const char c : text) {
        if (c < '0' || c > '9') return std::nullopt;
        const auto digit = static_cast<std::uint64_t>(c - '0');
        value = value > (kMost - digit) / 10 ? kMost : value * 10 + digit;
    }
    return value;
}

ByteRange last_bytes(std::uint64_t count, std::uint64_t size) {
    if (count == 0 || size == 0) return {ByteRange::Kind::kUnsatisfiable, 0, 0};
    return {ByteRange::Kind::kPart, size - std::min(count, size), size - 1};
}

ByteRange one_range(std::string_view range, std::uint64_t size) {
    const std::size_t dash = range.find('-');
    if (dash == std::string_view::npos) return {};
    const std::optional<std::uint64_t> first = number(range.substr(0, dash));
    const std::optional<std::uint64_t> last = number(range.substr(dash + 1));
    if (dash == 0) return last ? last_bytes(*last, size) : ByteRange{};
    if (!first || (!last && dash + 1 != range.size()) || (last && *last < *first)) return {};
    if (*first >= size) return {ByteRange::Kind::kUnsatisfiable, 0, 0};
    return {ByteRange::Kind::kPart, *first, std::min(last.value_or(size - 1), size - 1)};
}

}  // namespace

ByteRange parse_range(std::string_view header, std::uint64_t size) {
    const std::string_view unit = take(header, '=');
    if (!same_token(unit, "bytes")) return {};
    std::string_view only;
    while (!header.empty()) {
        const std::string_view range = take(header, ',');
        if (range.empty()) continue;
        if (!only.empty()) return {};
        only = range;
    }
    return one_range(only, size);
}

}  // namespace vsplit::rest
