#include "guard/token_file.h"

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

namespace vsplit::guard {
namespace {

constexpr std::string_view kReadOnly = "read-only";
constexpr std::string_view kReadWrite = "read-write";
constexpr std::size_t kLongestName = 64;

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

// The next word of the line, which loses it; empty at the end.
std::string_view take_word(std::string_view& line) {
    const auto* const first = std::find_if_not(line.begin(), line.end(), is_blank);
    const auto* const last = std::find_if(first, line.end(), is_blank);
    const std::string_view word(first, static_cast<std::size_t>(last - first));
    line.remove_prefix(static_cast<std::size_t>(last - line.begin()));
    return word;
}

std::optional<unsigned> hex_digit(char c) {
    if (c >= '0' && c <= '9') return static_cast<unsigned>(c - '0');
    if (c >= 'a' && c <= 'f') return static_cast<unsigned>(c - 'a') + 10U;
    if (c >= 'A' && c <= 'F') return static_cast<unsigned>(c - 'A') + 10U;
    return std::nullopt;
}

std::optional<Digest> parse_digest(std::string_view text) {
    Digest digest{};
    if (text.size() != 2 * digest.size()) return std::nullopt;
    for (std::size_t i = 0; i < digest.size(); ++i) {
        const std::optional<unsigned> high = hex_digit(text[2 * i]);
        const std::optional<unsigned> low = hex_digit(text[2 * i + 1]);
        if (!high || !low) return std::nullopt;
        digest[i] = static_cast<unsigned char>(*high * 16 + *low);
    }
    return digest;
}

// What is wrong with a line, or its token. What a line holds is never repeated: it may be a token by mistake.
struct LineResult {
    Token token;
    const char* wrong = nullptr;
};

LineResult parse_line(std::string_view line) {
    LineResult result;
    const std::string_view name = take_word(line);
    const std::string_view access = take_word(line);
    const std::optional<Digest> digest = parse_digest(take_word(line));
    if (!is_token_name(name)) {
        result.wrong = "the first word is no name: 1 to 64 of letters, digits, '.', '_' and '-'";
    } else if (access != kReadOnly && access != kReadWrite) {
        result.wrong = "the second word is neither read-only nor read-write";
    } else if (!digest) {
        result.wrong = "the third word is no SHA-256 of 64 hexadecimal digits";
    } else if (!take_word(line).empty()) {
        result.wrong = "there are more than three words";
    } else {
        result.token = {std::string(name), access == kReadWrite ? Access::kWrite : Access::kRead, *digest};
    }
    return result;
}

std::string_view without_comment(std::string_view line) { return line.substr(0, line.find('#')); }

}  // namespace

bool is_token_name(std::string_view name) {
    return !name.empty() && name.size() <= kLongestName && std::all_of(name.begin(), name.end(), [](char c) {
        return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '.' || c == '_' || c == '-';
    });
}

std::string token_line(const Token& token) {
    return token.name + ' ' + std::string(token.access == Access::kWrite ? kReadWrite : kReadOnly) + ' ' +
           hex_digits(token.digest);
}

Expected<std::vector<Token>> parse_token_file(std::string_view text, std::string_view source) {
    const std::string name(source);
    if (text.size() > kMostTokenFileBytes) {
        return Error{Cause::kLimitExceeded, name + " is longer than " + std::to_string(kMostTokenFileBytes) + " bytes",
                     "token-file"};
    }
    std::vector<Token> tokens;
    std::set<Digest> digests;
    for (std::size_t number = 1; !text.empty(); ++number) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        std::string_view line = without_comment(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
        if (std::all_of(line.begin(), line.end(), is_blank)) continue;
        LineResult parsed = parse_line(line);
        if (parsed.wrong == nullptr && !digests.insert(parsed.token.digest).second) parsed.wrong = "the hash was used before";
        if (parsed.wrong != nullptr) {
            return Error{Cause::kMalformedInput,
                         name + ", line " + std::to_string(number) + ": " + parsed.wrong +
                             "; accepted is NAME read-only|read-write SHA256, as vsplitd --new-token prints it",
                         "token-file"};
        }
        tokens.push_back(std::move(parsed.token));
    }
    if (tokens.empty()) return Error{Cause::kEmptyInput, name + " holds no token", "token-file"};
    return tokens;
}

}  // namespace vsplit::guard
