#pragma once

#include <array>
#include <charconv>
#include <cstddef>
#include <string>

namespace vsplit {

/// A number in at most `width` characters, as precise as that allows: the shortest text that reads back equal where it fits, else
/// rounded to fewer digits. `spelt(text)` is how the format writes what C does, such as an exponent without its letter.
/// \pre width >= 10.
template <class Spelt>
[[nodiscard]] std::string number_within(double value, std::size_t width, Spelt spelt) {
    std::array<char, 32> digits;
    std::string text = spelt(std::string(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr));
    for (int precision = 17; text.size() > width && precision > 0; --precision) {
        for (const auto form : {std::chars_format::general, std::chars_format::scientific}) {
            if (text.size() <= width) break;
            const int behind = form == std::chars_format::general ? precision : precision - 1;
            const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value, form, behind);
            text = spelt(std::string(digits.data(), end.ptr));
        }
    }
    return text;
}

}  // namespace vsplit
