// Files of tokens: nothing but tokens or an error, and what is read is read again from what is written.

#include "guard/token_file.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "check.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace vsplit;
    const auto tokens = guard::parse_token_file({reinterpret_cast<const char*>(data), size}, "tokens");
    if (!tokens) return 0;
    std::string lines;
    for (const guard::Token& token : *tokens) lines += guard::token_line(token) + '\n';
    const auto again = guard::parse_token_file(lines, "lines");
    fuzz::check(again && again->size() == tokens->size(), "what was written is read the same");
    for (std::size_t i = 0; i < tokens->size(); ++i) {
        fuzz::check((*again)[i].name == (*tokens)[i].name && (*again)[i].digest == (*tokens)[i].digest,
                    "what was written is read the same");
        fuzz::check((*again)[i].access == (*tokens)[i].access, "what was written is read the same");
    }
    return 0;
}
