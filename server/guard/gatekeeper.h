#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "guard/rate_limiter.h"
#include "guard/token_book.h"
#include "vsplit/base/expected.h"

namespace vsplit::guard {

/// What a call shows at the door.
struct Visitor {
    std::string_view authorization;  ///< "Bearer TOKEN", as HTTP has it
    std::string_view peer;           ///< address of the client, without its port
};

/// Decides who comes in. Thread-safe.
class Gatekeeper {
public:
    /// \param tokens null: everybody comes in, as the owner ""
    /// \param per_second requests of a client; 0: no limit
    explicit Gatekeeper(std::unique_ptr<TokenBook> tokens = nullptr, double per_second = 0)
        : tokens_(std::move(tokens)), rates_(per_second) {}

    /// The owner that the call is made for: the name of its token. A client is its token, or its address where it has none.
    /// \return UNAUTHENTICATED without a token that is known, FORBIDDEN for one that does not allow so much, LIMIT_EXCEEDED.
    [[nodiscard]] Expected<std::string> admit(const Visitor& visitor, Access needed);

    /// Whether `authorization` has a token of the book; true without a book. Counts nothing. O(tokens).
    /// \return UNAUTHENTICATED.
    [[nodiscard]] Status recognise(std::string_view authorization);

    /// The name of the token; empty for none of the book. Counts nothing. O(tokens).
    [[nodiscard]] std::string name_of(std::string_view authorization);

private:
    [[nodiscard]] Status take_turn(std::string_view kind, std::string_view client);

    const std::unique_ptr<TokenBook> tokens_;
    RateLimiter rates_;
};

}  // namespace vsplit::guard
