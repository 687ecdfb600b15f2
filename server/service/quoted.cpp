#include "service/quoted.h"

namespace vsplit::service {

std::string quoted(std::string_view text) {
    static constexpr std::size_t kMost = 64;
    std::string out = "\"";
    for (const char c : text.substr(0, kMost)) out += c >= ' ' && c <= '~' && c != '"' ? c : '?';
    if (text.size() > kMost) out += "...";
    return out + '"';
}

}  // namespace vsplit::service
