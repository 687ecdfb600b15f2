#include "rest/byte_range.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <system_error>

namespace vsplit::rest {
namespace {

std::optional<std::uint64_t> number(std::string_view text) {
    std::uint64_t value = 0;
    const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (failed != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return value;
}

ByteRange last_bytes(std::uint64_t count, std::uint64_t size) {
    if (count == 0 || size == 0) return {ByteRange::Kind::kUnsatisfiable, 0, 0};
    return {ByteRange::Kind::kPart, size - std::min(count, size), size - 1};
}

}  // namespace

ByteRange parse_range(std::string_view header, std::uint64_t size) {
    constexpr std::string_view kUnit = "bytes=";
    if (header.substr(0, kUnit.size()) != kUnit) return {};
    const std::string_view range = header.substr(kUnit.size());
    const std::size_t dash = range.find('-');
    if (dash == std::string_view::npos) return {};
    const std::optional<std::uint64_t> first = number(range.substr(0, dash));
    const std::optional<std::uint64_t> last = number(range.substr(dash + 1));
    if (dash == 0) return last ? last_bytes(*last, size) : ByteRange{};
    if (!first || (!last && dash + 1 != range.size()) || (last && *last < *first)) return {};
    if (*first >= size) return {ByteRange::Kind::kUnsatisfiable, 0, 0};
    return {ByteRange::Kind::kPart, *first, std::min(last.value_or(size - 1), size - 1)};
}

}  // namespace vsplit::rest
