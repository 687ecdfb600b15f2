#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "guard/digest.h"
#include "vsplit/base/expected.h"

namespace vsplit::guard {

/// What a token allows: reading alone, or everything.
enum class Access { kRead, kWrite };

/// A bearer token as the server knows it: never the token itself.
struct Token {
    std::string name;  ///< who has it; sessions belong to this name, and so to all tokens of the name
    Access access = Access::kRead;
    Digest digest{};  ///< of the token
};

inline constexpr std::size_t kMostTokenFileBytes = std::size_t{1} << 20;

/// Shorter ones could be guessed, since their hash is not salted.
inline constexpr std::size_t kShortestToken = 32;

/// Reads a file of tokens, one a line: NAME read-only|read-write SHA256, the last as 64 hexadecimal digits; what follows a # and
/// empty lines are left out. `source` names the file in messages. O(bytes log tokens).
/// \return MALFORMED_INPUT with the line; LIMIT_EXCEEDED for more than kMostTokenFileBytes; EMPTY_INPUT for a file of no token.
[[nodiscard]] Expected<std::vector<Token>> parse_token_file(std::string_view text, std::string_view source);

/// The line of a file for a token.
[[nodiscard]] std::string token_line(const Token& token);

/// Whether a name may stand in a file: 1 to 64 of letters, digits, '.', '_' and '-'.
[[nodiscard]] bool is_token_name(std::string_view name);

}  // namespace vsplit::guard
