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

std::string found(std::string_view word) { return word.empty() ? "found the line's end" : "found " + quoted(word); }

std::string to_text(double value) {
    std::array<char, 32> text;
    const std::to_chars_result end = std::to_chars(text.data(), text.data() + text.size(), value);
    return {text.data(), end.ptr};
}

}  // namespace vsplit
