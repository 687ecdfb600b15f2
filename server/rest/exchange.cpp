#include "rest/exchange.h"

#include <utility>

namespace vsplit::rest {
namespace {

constexpr unsigned kUnauthorized = 401;
constexpr unsigned kRequestTimeout = 408;

// Boost 1.74's string_view is its own.
std::string_view standard(beast::string_view text) { return {text.data(), text.size()}; }

}  // namespace

Exchange::Exchange(Stream& stream, beast::flat_buffer& buffer, RequestParser& parser, ResponseManner manner,
                   const RestLimits& limits, RequestMark mark)
    : stream_(stream),
      request_(parser.get()),
      limits_(limits),
      mark_(std::move(mark)),
      body_(stream, buffer, parser, limits),
      response_(stream, std::move(manner), limits),
      leave_watch_(stream, buffer, limits.ahead_bytes) {}

std::string_view Exchange::method() const { return standard(request_.method_string()); }

std::string_view Exchange::target() const { return standard(request_.target()); }

std::string_view Exchange::header(http::field name) const { return standard(request_[name]); }

std::string_view Exchange::header(std::string_view name) const {
    return standard(request_[beast::string_view(name.data(), name.size())]);
}

std::string Exchange::list(http::field name) const {
    std::string all;
    const auto fields = request_.equal_range(name);
    for (auto field = fields.first; field != fields.second; ++field) {
        all += (all.empty() ? "" : ", ") + std::string(standard(field->value()));
    }
    return all;
}

Awaitable<void> Exchange::fail(const Problem& of_engine) {
    if (response_.begun()) {
        response_.close_after();
        co_return;
    }
    Problem problem = of_engine;
    // For a deadline that the client's own body has passed HTTP has another name.
    if (body_.stalled() && problem.error.cause == Cause::kDeadlineExceeded) problem.status = kRequestTimeout;
    if (!body_.at_end()) response_.close_after();
    ResponseHead head;
    head.status = problem.status;
    head.content_type = kProblemType;
    if (!problem.allow.empty()) head.fields.emplace_back("Allow", problem.allow);
    if (!problem.content_range.empty()) head.fields.emplace_back("Content-Range", problem.content_range);
    if (problem.status == kUnauthorized) head.fields.emplace_back("WWW-Authenticate", "Bearer");
    if (problem.error.retry_after > 0) head.fields.emplace_back("Retry-After", std::to_string(problem.error.retry_after));
    const std::string text = problem_json(problem);
    co_await response_.respond(head, text);
}

}  // namespace vsplit::rest
