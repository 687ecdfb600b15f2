#include "guard/token_book.h"

#include <openssl/crypto.h>

#include <utility>

namespace vsplit::guard {

TokenBook::TokenBook(std::string file, Tokens tokens, ReloadObserver observer)
    : file_(std::move(file)),
      observer_(std::move(observer)),
      watched_({file_}),
      tokens_(std::make_shared<const Tokens>(std::move(tokens))) {}

Expected<TokenBook::Tokens> TokenBook::read(const std::string& file) {
    const Expected<std::string> text = read_small_file(file, kMostTokenFileBytes);
    if (!text) return text.error();
    return parse_token_file(*text, file);
}

Expected<std::unique_ptr<TokenBook>> TokenBook::open(const std::string& file, ReloadObserver observer) {
    Expected<Tokens> tokens = read(file);
    if (!tokens) return tokens.error();
    return std::unique_ptr<TokenBook>(new TokenBook(file, *std::move(tokens), std::move(observer)));
}

std::shared_ptr<const TokenBook::Tokens> TokenBook::current() {
    const std::lock_guard lock(mutex_);
    if (!watched_.changed()) return tokens_;
    Expected<Tokens> tokens = read(file_);
    const Status read_anew = tokens ? Status(Done{}) : Status(tokens.error());
    if (watched_.note(read_anew) && observer_) observer_(file_, read_anew);
    if (tokens) tokens_ = std::make_shared<const Tokens>(*std::move(tokens));
    return tokens_;
}

std::optional<TokenBook::Holder> TokenBook::find(std::string_view token) {
    const std::shared_ptr<const Tokens> tokens = current();
    const Digest digest = digest_of(token);
    std::size_t found = tokens->size();
    for (std::size_t i = 0; i < tokens->size(); ++i) {
        const Token& known = (*tokens)[i];
        // No way out early: which one it was takes as long as none.
        const bool same = CRYPTO_memcmp(known.digest.data(), digest.data(), digest.size()) == 0;
        found = same ? i : found;
    }
    if (found == tokens->size()) return std::nullopt;
    return Holder{(*tokens)[found].name, (*tokens)[found].access};
}

}  // namespace vsplit::guard
