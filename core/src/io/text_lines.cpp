#include "io/text_lines.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace vsplit {
namespace {

constexpr bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

std::string_view without_plus(std::string_view word) {
    const bool plus = word.size() > 1 && word[0] == '+' && word[1] != '-';
    return plus ? word.substr(1) : word;
}

/// What a number is that from_chars found out of range: the power of ten of its first digit says which side.
double out_of_range(std::string_view word) {
    const bool negative = word.front() == '-';
    const std::size_t e = std::min(word.find_first_of("eE"), word.size());
    const std::string_view mantissa = word.substr(0, e);
    const std::size_t point = std::min(mantissa.find('.'), mantissa.size());
    const std::size_t digit = std::min(mantissa.find_first_of("123456789"), mantissa.size());
    // from_chars has seen that the exponent is digits; one too long for an integer decides alone.
    const std::optional<std::int64_t> exponent = e == word.size() ? 0 : parse_integer(word.substr(e + 1));
    const bool small = exponent ? static_cast<double>(point) - static_cast<double>(digit) + static_cast<double>(*exponent) < 0
                                : word.find('-', e) != std::string_view::npos;
    const double magnitude = small ? 0.0 : std::numeric_limits<double>::infinity();
    return negative ? -magnitude : magnitude;
}

}  // namespace

std::string_view as_text(std::span<const std::byte> bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }

std::string_view without_mark(std::string_view text) {
    constexpr std::string_view kMark = "\xEF\xBB\xBF";
    return text.starts_with(kMark) ? text.substr(kMark.size()) : text;
}

TextLines::TextLines(std::string_view text)
    : rest_(text), end_(text.find('\n') == std::string_view::npos && text.find('\r') != std::string_view::npos ? '\r' : '\n') {}

bool TextLines::next() {
    if (rest_.empty()) return false;
    const std::size_t end = std::min(rest_.find(end_), rest_.size());
    line_ = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    if (line_.ends_with('\r')) line_.remove_suffix(1);
    ++number_;
    return true;
}

bool TextLines::next_content(char comment) {
    while (next()) {
        line_ = line_.substr(0, line_.find(comment));
        if (!std::all_of(line_.begin(), line_.end(), is_space)) return true;
    }
    return false;
}

std::string_view next_word(std::string_view& line) {
    const char* from = line.data();
    const char* const end = from + line.size();
    while (from != end && is_space(*from)) ++from;
    const char* to = from;
    while (to != end && !is_space(*to)) ++to;
    line = {to, static_cast<std::size_t>(end - to)};
    return {from, static_cast<std::size_t>(to - from)};
}

std::string upper_case(std::string_view text) {
    std::string upper(text);
    for (char& c : upper) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    return upper;
}

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
    return text;
}

std::string_view next_field(std::string_view& line, char separator) {
    const std::size_t end = std::min(line.find(separator), line.size());
    const std::string_view field = trimmed(line.substr(0, end));
    line.remove_prefix(std::min(end + 1, line.size()));
    return field;
}

bool equals_ignoring_case(std::string_view left, std::string_view right) {
    const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
    return std::equal(left.begin(), left.end(), right.begin(), right.end(), [&](char a, char b) { return lower(a) == lower(b); });
}

std::optional<double> parse_number(std::string_view word) {
    word = without_plus(word);
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (end != word.data() + word.size() || error == std::errc::invalid_argument) return {};
    return error == std::errc::result_out_of_range ? out_of_range(word) : value;
}

std::optional<double> parse_fortran_number(std::string_view word) {
    if (const std::optional<double> value = parse_number(word)) return value;
    if (word.find_first_not_of("0123456789.+-dDeE") != std::string_view::npos) return {};
    std::string text(word);
    for (char& c : text) c = c == 'd' || c == 'D' ? 'e' : c;
    const std::size_t sign = text.find_last_of("+-");
    if (sign != std::string::npos && sign > 0 && text[sign - 1] != 'e' && text[sign - 1] != 'E') text.insert(sign, "e");
    return parse_number(text);
}

std::optional<std::int64_t> parse_integer(std::string_view word) {
    word = without_plus(word);
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (end != word.data() + word.size() || error != std::errc()) return {};
    return value;
}

}  // namespace vsplit
