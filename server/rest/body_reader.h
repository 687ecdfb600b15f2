#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "rest/asio.h"
#include "rest/rest_options.h"
#include "rest/stream.h"
#include "vsplit/base/expected.h"

namespace vsplit::rest {

using RequestParser = http::request_parser<http::buffer_body>;

/// The body of one request, as it comes in: nothing is read before somebody asks for it, and then no more than fits.
class BodyReader {
public:
    BodyReader(Stream& stream, beast::flat_buffer& buffer, RequestParser& parser, const RestLimits& limits);

    /// Bytes of the body; empty when it comes in chunks.
    [[nodiscard]] std::optional<std::uint64_t> declared_size() const;

    [[nodiscard]] bool at_end() const { return parser_.is_done(); }
    [[nodiscard]] std::uint64_t received() const { return received_; }

    /// Whether the client sent nothing for too long, or too little: there is somebody to tell, and no more to read.
    [[nodiscard]] bool stalled() const { return stalled_; }

    /// Whether the client waits for a word before it sends the body.
    [[nodiscard]] bool client_waits() const { return client_waits_; }

    /// Fills some of `room`; 0 at the end. Tells a client that waits to go on. \return MALFORMED_INPUT, DEADLINE_EXCEEDED for a
    /// client that stalls or trickles, CANCELLED when it is gone.
    Awaitable<Expected<std::size_t>> read_some(std::span<char> room);

private:
    [[nodiscard]] Error failure(const ErrorCode& code) const;
    Awaitable<ErrorCode> say_continue();
    [[nodiscard]] std::chrono::steady_clock::time_point deadline() const;

    Stream& stream_;
    beast::flat_buffer& buffer_;
    RequestParser& parser_;
    const RestLimits& limits_;
    const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    std::uint64_t received_ = 0;
    bool client_waits_ = false;
    bool stalled_ = false;
};

}  // namespace vsplit::rest
