#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "rest/asio.h"
#include "rest/body_reader.h"
#include "rest/leave_watch.h"
#include "rest/problem.h"
#include "rest/request_mark.h"
#include "rest/response_writer.h"
#include "rest/stream.h"
#include "rest/target.h"

namespace vsplit::rest {

/// One request and its answer, which a handler writes. For one coroutine on the connection's strand.
class Exchange {
public:
    Exchange(Stream& stream, beast::flat_buffer& buffer, RequestParser& parser, ResponseManner manner, const RestLimits& limits,
             RequestMark mark = {});

    [[nodiscard]] const http::request<http::buffer_body>& request() const { return request_; }
    [[nodiscard]] std::string_view method() const;
    [[nodiscard]] std::string_view target() const;

    /// A header field of the request; empty when it has none.
    [[nodiscard]] std::string_view header(http::field name) const;
    [[nodiscard]] std::string_view header(std::string_view name) const;

    /// One that is a list, which may stand in several fields: all of it.
    [[nodiscard]] std::string list(http::field name) const;

    [[nodiscard]] BodyReader& body() { return body_; }
    [[nodiscard]] ResponseWriter& response() { return response_; }
    [[nodiscard]] LeaveWatch& leave_watch() { return leave_watch_; }
    [[nodiscard]] net::any_io_executor executor() { return stream_.get_executor(); }
    [[nodiscard]] const RestLimits& limits() const { return limits_; }
    [[nodiscard]] const RequestMark& mark() const { return mark_; }

    /// Answers with a problem; where an answer has begun already, cuts it off instead, so that nobody takes it for whole.
    Awaitable<void> fail(const Problem& problem);

private:
    Stream& stream_;
    const http::request<http::buffer_body>& request_;
    const RestLimits& limits_;
    const RequestMark mark_;
    BodyReader body_;
    ResponseWriter response_;
    LeaveWatch leave_watch_;
};

}  // namespace vsplit::rest
