#include "rest/connection.h"

#include <netinet/tcp.h>

#include <array>
#include <limits>
#include <optional>
#include <utility>

#include "rest/problem.h"

namespace vsplit::rest {
namespace {

// For the last answer to reach a client that is still sending: closed at once, TCP would take it back.
constexpr std::chrono::seconds kLingerTime{2};
constexpr std::chrono::seconds kRefusalTime{2};  // for TLS with who is turned away
constexpr std::size_t kLingerBytes = std::size_t{8} << 20;

#if defined(TCP_NOTSENT_LOWAT)
// Of what has not been sent the kernel would hold megabytes for a client that reads nothing: for hundreds of them that is
// memory, and the time of the threads that everybody waits for. What is on its way counts apart, so that a fast client is as
// fast.
using UnsentBytes = net::detail::socket_option::integer<IPPROTO_TCP, TCP_NOTSENT_LOWAT>;
constexpr int kUnsentBytes = 64 * 1024;
#endif

std::optional<Problem> header_problem(const ErrorCode& why, const RestLimits& limits) {
    if (why == http::error::header_limit || why == http::error::buffer_overflow) {
        return http_problem(
            431, Cause::kLimitExceeded,
            "first line and header are longer than " + std::to_string(limits.header_bytes) + " bytes, the server's limit");
    }
    if (why == http::error::bad_version) {
        return http_problem(505, Cause::kUnsupported,
                            "the HTTP version is not one that is spoken here; accepted are 1.0 and 1.1");
    }
    const bool broken = why.category() == make_error_code(http::error::bad_chunk).category() &&
                        why != http::error::end_of_stream && why != http::error::partial_message;
    if (!broken) return std::nullopt;  // gone, or too slow: there is nobody to tell
    return http_problem(400, Cause::kMalformedInput, "not an HTTP request: " + why.message());
}

std::optional<Problem> check_header(const http::request<http::buffer_body>& request) {
    if (request.version() != 10 && request.version() != 11) {
        return http_problem(505, Cause::kUnsupported,
                            "the HTTP version is not one that is spoken here; accepted are 1.0 and 1.1");
    }
    if (request.version() == 11 && request.count(http::field::host) != 1) {
        return http_problem(400, Cause::kMalformedInput, "an HTTP/1.1 request has one Host field", "Host");
    }
    if (request.method() == http::verb::unknown) {
        return http_problem(501, Cause::kUnsupported,
                            "no such method is known; accepted are DELETE, GET, HEAD, OPTIONS, POST and PUT");
    }
    // Where two readers of a message disagree about its end, one takes what follows for another request.
    const auto coding = request[http::field::transfer_encoding];
    const bool coded = request.count(http::field::transfer_encoding) > 0;
    if (coded &&
        (request.version() != 11 || request.count(http::field::transfer_encoding) > 1 || !beast::iequals(coding, "chunked"))) {
        return http_problem(501, Cause::kUnsupported,
                            "the transfer coding is not understood; accepted is chunked alone, in HTTP/1.1", "Transfer-Encoding");
    }
    const auto expect = request[http::field::expect];
    if (!expect.empty() && !beast::iequals(expect, "100-continue")) {
        return http_problem(417, Cause::kUnsupported, "Expect is not understood; accepted is 100-continue", "Expect");
    }
    return std::nullopt;
}

std::string peer_of(Stream& stream) {
    ErrorCode failed;
    const net::ip::tcp::endpoint peer = stream.socket().remote_endpoint(failed);
    return failed ? "" : peer.address().to_string();
}

RequestMark mark_of(const http::request<http::buffer_body>& request, Stream& stream) {
    const auto field = [&request](const char* name) {
        const auto text = request[name];
        return std::string_view(text.data(), text.size());
    };
    return mark_request(field(wire::kRequestIdKey), field(wire::kTraceparentKey), peer_of(stream));
}

ResponseManner with_mark(ResponseManner manner, const RequestMark& mark) {
    manner.fields.emplace_back("X-Request-Id", mark.id);
    manner.fields.emplace_back(wire::kTraceparentKey, wire::to_traceparent(mark.trace));
    return manner;
}

}  // namespace

Connection::Connection(net::ip::tcp::socket socket, std::shared_ptr<net::ssl::context> tls, Gateway& gateway,
                       HttpObserver observer)
    : stream_(std::move(socket), std::move(tls)), gateway_(gateway), observer_(std::move(observer)) {
    constexpr std::size_t kOneRead = 65536;
    buffer_.max_size(gateway.limits().header_bytes + gateway.limits().ahead_bytes + kOneRead);
    ErrorCode ignored;
    stream_.socket().set_option(net::ip::tcp::no_delay(true), ignored);
#if defined(TCP_NOTSENT_LOWAT)
    stream_.socket().set_option(UnsentBytes(kUnsentBytes), ignored);
#endif
    // LeaveWatch reads when the socket is said to be readable, which is not always so.
    stream_.socket().non_blocking(true, ignored);
}

void Connection::drain() {
    net::post(stream_.get_executor(), [self = shared_from_this()] {
        self->draining_ = true;
        if (self->idle_) self->stream_.close();
    });
}

void Connection::close() {
    net::post(stream_.get_executor(), [self = shared_from_this()] { self->stream_.close(); });
}

Awaitable<bool> Connection::secure(std::chrono::milliseconds longest) {
    if (!stream_.secure()) co_return true;
    stream_.expires_after(longest);
    const ErrorCode failed = co_await stream_.handshake();
    // Who only looks whether somebody listens, and says nothing, is another error.
    const auto& on_failed = gateway_.options().on_tls_failed;
    if (failed.category() == net::error::get_ssl_category() && on_failed) on_failed(peer_of(stream_), failed.message());
    co_return !failed;
}

Awaitable<void> Connection::run() {
    if (!co_await secure(gateway_.limits().header_time)) {
        stream_.close();
        co_return;
    }
    for (std::size_t served = 1; served == 1 || !draining_; ++served) {
        if (!co_await wait_for_request()) break;
        idle_ = false;
        if (!co_await serve_one(served >= gateway_.limits().requests)) break;
        idle_ = true;
    }
    stream_.expires_after(kLingerTime);
    co_await stream_.say_end();
    stream_.close();
}

Awaitable<void> Connection::refuse() {
    RequestParser parser;
    RequestMark mark = mark_of(parser.get(), stream_);
    if (!co_await secure(kRefusalTime)) {
        stream_.close();
        co_return;
    }
    ResponseManner manner = with_mark({11, false, false, {}}, mark);
    Exchange exchange(stream_, buffer_, parser, std::move(manner), gateway_.limits(), std::move(mark));
    Error error{Cause::kUnavailable,
                "the server has " + std::to_string(gateway_.limits().connections) + " connections, its limit max_connections", "",
                1};
    co_await exchange.fail(problem_of(error));
    tell_refusal(exchange);
    co_await linger();
    stream_.close();
}

Awaitable<bool> Connection::wait_for_request() {
    if (buffer_.size() > 0) co_return true;
    constexpr std::size_t kFirst = 4096;
    stream_.expires_after(gateway_.limits().idle_time);
    ErrorCode failed;
    const std::size_t got = co_await stream_.async_read_some(buffer_.prepare(kFirst), into(failed));
    buffer_.commit(got);
    co_return !failed;
}

Awaitable<bool> Connection::serve_one(bool last) {
    const RestLimits& limits = gateway_.limits();
    RequestParser parser;
    parser.header_limit(limits.header_bytes);
    parser.body_limit(std::numeric_limits<std::uint64_t>::max());  // handlers and the service know how much is too much
    stream_.expires_after(limits.header_time);
    ErrorCode failed;
    co_await http::async_read_header(stream_, buffer_, parser, into(failed));
    if (failed) {
        co_await refuse_header(parser, failed);
        co_return false;
    }
    ResponseManner manner = gateway_.manner_of(parser.get());
    if (last || draining_) manner.keep_alive = false;
    RequestMark mark = mark_of(parser.get(), stream_);
    manner = with_mark(std::move(manner), mark);
    Exchange exchange(stream_, buffer_, parser, std::move(manner), limits, std::move(mark));
    const auto start = std::chrono::steady_clock::now();
    co_await answer(exchange);
    co_await exchange.leave_watch().stop();
    if (observer_) {
        observer_({std::string(exchange.method()), std::string(exchange.target()), exchange.response().status(),
                   exchange.body().received(), exchange.response().sent(), std::chrono::steady_clock::now() - start,
                   exchange.mark()});
    }
    const bool more = exchange.response().keeps_alive() && exchange.body().at_end();
    if (!exchange.body().at_end()) co_await linger();
    co_return more;
}

Awaitable<void> Connection::answer(Exchange& exchange) {
    std::optional<Problem> problem = check_header(exchange.request());
    if (problem) {  // where such a request ends is not sure, so nothing after it is read as another
        exchange.response().close_after();
        co_await exchange.fail(*problem);
        co_return co_await linger();
    }
    try {
        co_await gateway_.serve(exchange);
    } catch (const std::bad_alloc&) {
        problem = problem_of(Error{Cause::kLimitExceeded, "the server has not enough memory for this request", "", 1});
    } catch (const std::exception& thrown) {
        problem = problem_of(Error{Cause::kInternal, std::string("unexpected failure: ") + thrown.what(), ""});
    }
    if (problem) co_await exchange.fail(*problem);
}

Awaitable<void> Connection::refuse_header(RequestParser& parser, const ErrorCode& why) {
    std::optional<Problem> problem = header_problem(why, gateway_.limits());
    if (!problem) co_return;
    RequestMark mark = mark_of(parser.get(), stream_);  // of what could be read
    ResponseManner manner = with_mark({11, false, false, {}}, mark);
    Exchange exchange(stream_, buffer_, parser, std::move(manner), gateway_.limits(), std::move(mark));
    co_await exchange.fail(*problem);
    tell_refusal(exchange);
    co_await linger();
}

void Connection::tell_refusal(Exchange& exchange) {
    if (observer_) observer_({"-", "-", exchange.response().status(), 0, exchange.response().sent(), {}, exchange.mark()});
}

Awaitable<void> Connection::linger() {
    ErrorCode failed;
    stream_.expires_after(kLingerTime);
    co_await stream_.say_end();
    stream_.socket().shutdown(net::socket_base::shutdown_send, failed);
    stream_.expires_after(kLingerTime);
    std::array<char, 16384> room{};
    for (std::size_t read = 0; !failed && read < kLingerBytes;) {
        read += co_await stream_.tcp().async_read_some(net::buffer(room), into(failed));
    }
}

}  // namespace vsplit::rest
