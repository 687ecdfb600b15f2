#pragma once

#include <boost/asio/ssl/stream.hpp>
#include <chrono>
#include <memory>
#include <optional>
#include <utility>

#include "rest/asio.h"

namespace vsplit::rest {

/// A client's connection, plain or in TLS, with the deadlines of Beast's tcp_stream. For one strand.
class Stream {
public:
    using executor_type = beast::tcp_stream::executor_type;  // NOLINT(readability-identifier-naming): Beast asks for this name

    /// `tls` is null for a plain one.
    Stream(net::ip::tcp::socket socket, std::shared_ptr<net::ssl::context> tls)
        : tcp_(std::move(socket)), context_(std::move(tls)) {
        if (context_ != nullptr) tls_.emplace(tcp_, *context_);
    }

    [[nodiscard]] executor_type get_executor() { return tcp_.get_executor(); }
    [[nodiscard]] bool secure() const { return tls_.has_value(); }

    /// Below TLS.
    [[nodiscard]] net::ip::tcp::socket& socket() { return tcp_.socket(); }
    [[nodiscard]] beast::tcp_stream& tcp() { return tcp_; }

    void expires_after(std::chrono::steady_clock::duration time) { tcp_.expires_after(time); }
    void expires_at(std::chrono::steady_clock::time_point time) { tcp_.expires_at(time); }
    void expires_never() { tcp_.expires_never(); }
    void close() { tcp_.close(); }

    /// Agrees on keys. \pre secure(), and nothing was read or written.
    Awaitable<ErrorCode> handshake() {
        ErrorCode failed;
        co_await tls_->async_handshake(net::ssl::stream_base::server, into(failed));
        co_return failed;
    }

    /// Tells the client that no more comes, so that it knows the answer for whole. Nothing where it is plain.
    Awaitable<void> say_end() {
        if (!tls_) co_return;
        ErrorCode ignored;
        co_await tls_->async_shutdown(into(ignored));
    }

    template <class Buffers, class Handler>
    auto async_read_some(const Buffers& buffers, Handler&& handler) {
        if (tls_) return tls_->async_read_some(buffers, std::forward<Handler>(handler));
        return tcp_.async_read_some(buffers, std::forward<Handler>(handler));
    }

    template <class Buffers, class Handler>
    auto async_write_some(const Buffers& buffers, Handler&& handler) {
        if (tls_) return tls_->async_write_some(buffers, std::forward<Handler>(handler));
        return tcp_.async_write_some(buffers, std::forward<Handler>(handler));
    }

private:
    beast::tcp_stream tcp_;
    const std::shared_ptr<net::ssl::context> context_;
    std::optional<net::ssl::stream<beast::tcp_stream&>> tls_;
};

}  // namespace vsplit::rest
