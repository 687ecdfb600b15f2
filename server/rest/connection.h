#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>

#include "rest/asio.h"
#include "rest/gateway.h"
#include "rest/stream.h"

namespace vsplit::rest {

/// One request that was answered, or cut off.
struct HttpRecord {
    std::string method;
    std::string target;   ///< as the client wrote it: any bytes
    unsigned status = 0;  ///< 0 when no answer was begun
    std::uint64_t bytes_in = 0;
    std::uint64_t bytes_out = 0;
    std::chrono::steady_clock::duration elapsed{};
    RequestMark mark{};
};

/// Hears of every request at its end, from whatever thread. Must not block.
using HttpObserver = std::function<void(const HttpRecord&)>;

/// One client: reads requests and answers them one after another, in order.
class Connection : public std::enable_shared_from_this<Connection> {
public:
    /// `gateway` must outlive it. `tls` is null for a plain connection. `socket` has a strand of its own.
    Connection(net::ip::tcp::socket socket, std::shared_ptr<net::ssl::context> tls, Gateway& gateway, HttpObserver observer);

    /// Serves until the client leaves, breaks the rules, or the connection is drained or closed.
    Awaitable<void> run();

    /// Turns the client away: too many are here.
    Awaitable<void> refuse();

    /// No request after the one that is being answered. Any thread.
    void drain();

    /// No request after the first. Before `run`.
    void serve_one_only() { draining_ = true; }

    /// Ends it as it stands. Any thread.
    void close();

private:
    Awaitable<bool> secure(std::chrono::milliseconds longest);
    Awaitable<bool> wait_for_request();
    Awaitable<bool> serve_one(bool last);
    Awaitable<void> refuse_header(RequestParser& parser, const ErrorCode& why);
    Awaitable<void> answer(Exchange& exchange);
    void tell_refusal(Exchange& exchange);
    Awaitable<void> linger();

    Stream stream_;
    Gateway& gateway_;
    const HttpObserver observer_;
    beast::flat_buffer buffer_;
    bool draining_ = false;
    bool idle_ = true;
};

}  // namespace vsplit::rest
