#include "base/quoted.h"

namespace vsplit {

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

}  // namespace vsplit
