#include "wire/utf8.h"

#include <array>

namespace vsplit::wire {
namespace {

/// The lead bytes that start a sequence of one length, and the range its second byte must lie in.
struct Lead {
    unsigned char first, last;
    std::size_t length;
    unsigned char second_low, second_high;
};

// Table 3-7 of the Unicode Standard: no overlong forms, no surrogates, nothing above U+10FFFF.
constexpr std::array<Lead, 9> kLeads{{{0x00, 0x7f, 1, 0, 0},
                                      {0xc2, 0xdf, 2, 0x80, 0xbf},
                                      {0xe0, 0xe0, 3, 0xa0, 0xbf},
                                      {0xe1, 0xec, 3, 0x80, 0xbf},
                                      {0xed, 0xed, 3, 0x80, 0x9f},
                                      {0xee, 0xef, 3, 0x80, 0xbf},
                                      {0xf0, 0xf0, 4, 0x90, 0xbf},
                                      {0xf1, 0xf3, 4, 0x80, 0xbf},
                                      {0xf4, 0xf4, 4, 0x80, 0x8f}}};

unsigned char byte_at(std::string_view text, std::size_t i) { return static_cast<unsigned char>(text[i]); }

/// Length of the valid sequence that `text` begins with; 0 when there is none.
std::size_t sequence_length(std::string_view text) {
    for (const Lead& lead : kLeads) {
        if (byte_at(text, 0) < lead.first || byte_at(text, 0) > lead.last) continue;
        if (text.size() < lead.length) return 0;
        if (lead.length > 1 && (byte_at(text, 1) < lead.second_low || byte_at(text, 1) > lead.second_high)) return 0;
        for (std::size_t i = 2; i < lead.length; ++i) {
            if (byte_at(text, i) < 0x80 || byte_at(text, i) > 0xbf) return 0;
        }
        return lead.length;
    }
    return 0;
}

}  // namespace

std::string valid_utf8(std::string_view text, std::size_t max_bytes) {
    constexpr std::string_view kMore = "...";
    std::string result;
    std::size_t cut = 0;  // where the result still has room for kMore
    while (!text.empty()) {
        const std::size_t length = sequence_length(text);
        const std::string_view next = length == 0 ? std::string_view("?") : text.substr(0, length);
        if (result.size() + next.size() > max_bytes) return result.substr(0, cut).append(kMore);
        result += next;
        text.remove_prefix(length == 0 ? 1 : length);
        if (result.size() + kMore.size() <= max_bytes) cut = result.size();
    }
    return result;
}

}  // namespace vsplit::wire
