#include "guard/gatekeeper.h"

#include <optional>
#include <utility>

namespace vsplit::guard {
namespace {

constexpr std::string_view kScheme = "bearer ";

// The token of "Bearer TOKEN"; empty for anything else. The scheme's case does not matter (RFC 9110, 11.1).
std::string_view token_of(std::string_view authorization) {
    if (authorization.size() < kScheme.size()) return {};
    for (std::size_t i = 0; i < kScheme.size(); ++i) {
        const char c = authorization[i];
        const char lower = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
        if (lower != kScheme[i]) return {};
    }
    return authorization.substr(kScheme.size());
}

Error unauthenticated(std::string_view token) {
    const char* const what = token.empty() ? "the call carries no token" : "the call's token is none that this server knows";
    return {Cause::kUnauthenticated, std::string(what) + "; accepted is a header authorization: Bearer TOKEN", "authorization"};
}

}  // namespace

Expected<std::string> Gatekeeper::admit(const Visitor& visitor, Access needed) {
    if (tokens_ == nullptr) {
        if (Status turn = take_turn("address ", visitor.peer); !turn) return turn.error();
        return std::string();
    }
    const std::string_view token = token_of(visitor.authorization);
    std::optional<TokenBook::Holder> holder = tokens_->find(token);
    Status turn = holder ? take_turn("token ", holder->name) : take_turn("address ", visitor.peer);
    if (!turn) return turn.error();
    if (!holder) return unauthenticated(token);
    if (needed == Access::kWrite && holder->access == Access::kRead) {
        return Error{Cause::kForbidden, "the token of " + holder->name + " is read-only; this call needs one that is read-write",
                     "authorization"};
    }
    return std::move(holder->name);
}

Status Gatekeeper::recognise(std::string_view authorization) {
    const std::string_view token = token_of(authorization);
    if (tokens_ == nullptr || tokens_->find(token)) return Done{};
    return unauthenticated(token);
}

std::string Gatekeeper::name_of(std::string_view authorization) {
    std::optional<TokenBook::Holder> holder;
    if (tokens_ != nullptr) holder = tokens_->find(token_of(authorization));
    return holder ? std::move(holder->name) : std::string();
}

Status Gatekeeper::take_turn(std::string_view kind, std::string_view client) {
    const unsigned wait = rates_.take(std::string(kind) + std::string(client), RateLimiter::Clock::now());
    if (wait == 0) return Done{};
    return Error{
        Cause::kLimitExceeded,
        "more requests a second from " + std::string(kind) + std::string(client) + " than the server's limit max_request_rate",
        "", wait};
}

}  // namespace vsplit::guard
