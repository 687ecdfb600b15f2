#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace vsplit {

[[nodiscard]] std::string_view as_text(std::span<const std::byte> bytes);

/// `text` without a byte order mark.
[[nodiscard]] std::string_view without_mark(std::string_view text);

/// A text, line by line. Lines end in LF or CR LF, or in CR where there is no LF at all.
class TextLines {
public:
    explicit TextLines(std::string_view text);

    /// Goes to the next line; false at the end.
    bool next();

    /// Goes to the next line that holds more than white space and a comment from `comment` on, and cuts the comment off.
    bool next_content(char comment);

    /// The line without its end.
    [[nodiscard]] std::string_view line() const { return line_; }
    /// Its number, from 1; 0 before the first.
    [[nodiscard]] std::size_t number() const { return number_; }
    /// What follows the line.
    [[nodiscard]] std::string_view rest() const { return rest_; }

private:
    std::string_view rest_;
    std::string_view line_;
    std::size_t number_ = 0;
    char end_;
};

/// Takes the next word (between white space) off the front of `line`; empty when there is none.
[[nodiscard]] std::string_view next_word(std::string_view& line);

/// Letters of ASCII only.
[[nodiscard]] std::string upper_case(std::string_view text);

/// Without white space at either end.
[[nodiscard]] std::string_view trimmed(std::string_view text);

/// Takes what stands before the next `separator` off the front of `line`, trimmed; all of it where there is none.
[[nodiscard]] std::string_view next_field(std::string_view& line, char separator);

[[nodiscard]] bool equals_ignoring_case(std::string_view left, std::string_view right);

/// The number that `word` is, whole; in the C locale, a leading '+' allowed, "nan" and "inf" too. Too large gives infinity, too
/// small 0. Empty when it is no number.
[[nodiscard]] std::optional<double> parse_number(std::string_view word);

/// As parse_number, of a number as Fortran reads them: the exponent's letter may be a D, or left out: "1.D+4", "1.5-3".
[[nodiscard]] std::optional<double> parse_fortran_number(std::string_view word);

/// The integer that `word` is, whole. Empty when it is none or does not fit.
[[nodiscard]] std::optional<std::int64_t> parse_integer(std::string_view word);

}  // namespace vsplit
