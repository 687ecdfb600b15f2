#include "rest/body_reader.h"

#include <algorithm>
#include <string_view>

#include "rest/accept.h"
#include "rest/read_alarm.h"

namespace vsplit::rest {

BodyReader::BodyReader(Stream& stream, beast::flat_buffer& buffer, RequestParser& parser, const RestLimits& limits)
    : stream_(stream), buffer_(buffer), parser_(parser), limits_(limits) {
    const auto expect = parser.get()[http::field::expect];
    client_waits_ =
        !parser.is_done() && parser.get().version() >= 11 && same_token({expect.data(), expect.size()}, "100-continue");
}

std::optional<std::uint64_t> BodyReader::declared_size() const {
    if (parser_.chunked()) return std::nullopt;
    const auto length = parser_.content_length();
    return length ? *length : 0;
}

std::chrono::steady_clock::time_point BodyReader::deadline() const {
    return limits_.patience.deadline(start_, std::chrono::steady_clock::now(), received_);
}

Awaitable<ErrorCode> BodyReader::say_continue() {
    static constexpr std::string_view kContinue = "HTTP/1.1 100 Continue\r\n\r\n";
    client_waits_ = false;
    ErrorCode failed;
    co_await net::async_write(stream_, net::const_buffer(kContinue.data(), kContinue.size()), into(failed));
    co_return failed;
}

Error BodyReader::failure(const ErrorCode& code) const {
    if (stalled_) {
        return {
            Cause::kDeadlineExceeded,
            "the body stopped after " + std::to_string(received_) + " bytes or came too slowly; " + limits_.patience.accepted(),
            ""};
    }
    const bool broken = code.category() == make_error_code(http::error::bad_chunk).category() &&
                        code != http::error::partial_message && code != http::error::end_of_stream;
    if (broken) {
        return {Cause::kMalformedInput, "the body breaks HTTP after " + std::to_string(received_) + " bytes: " + code.message(),
                ""};
    }
    return {Cause::kCancelled, "the client is gone after " + std::to_string(received_) + " bytes of the body", ""};
}

Awaitable<Expected<std::size_t>> BodyReader::read_some(std::span<char> room) {
    if (client_waits_) {
        stream_.expires_after(limits_.patience.stall);
        if (const ErrorCode failed = co_await say_continue(); failed) co_return failure(failed);
    }
    auto& body = parser_.get().body();
    body.data = room.data();
    body.size = room.size();
    while (!parser_.is_done() && body.size == room.size()) {
        const ReadAlarm alarm(stream_, deadline());
        ErrorCode failed;
        co_await http::async_read_some(stream_, buffer_, parser_, into(failed));
        if (!failed || failed == http::error::need_buffer) continue;
        stalled_ = alarm.rang();
        co_return failure(failed);
    }
    const std::size_t got = room.size() - body.size;
    received_ += got;
    co_return got;
}

}  // namespace vsplit::rest
