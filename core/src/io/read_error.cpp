#include "io/read_error.h"

#include <array>
#include <charconv>

namespace vsplit {

Error read_error(Cause cause, Place place, std::string_view what) {
    std::string message(place.unit);
    message.append(" ").append(std::to_string(place.number));
    if (place.column != 0) message.append(", column ").append(std::to_string(place.column));
    message.append(": ").append(what);
    return {cause, std::move(message), ""};
}

std::string quoted(std::string_view text) {
    constexpr std::size_t kLongest = 40;
    constexpr std::string_view kDigits = "0123456789abcdef";
    std::string result = "'";
    for (const char c : text.substr(0, kLongest)) {
        const auto code = static_cast<unsigned char>(c);
        if (code >= 0x20 && code < 0x7F) {
            result += c;
        } else {
            result.append("\\x").append(1, kDigits[code >> 4]).append(1, kDigits[code & 15]);
        }
    }
    return result.append(text.size() > kLongest ? "...'" : "'");
}

std::string found(std::string_view word) { return word.empty() ? "found the line's end" : "found " + quoted(word); }

std::string to_text(double value) {
    std::array<char, 32> text;
    const std::to_chars_result end = std::to_chars(text.data(), text.data() + text.size(), value);
    return {text.data(), end.ptr};
}

}  // namespace vsplit
