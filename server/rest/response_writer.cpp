#include "rest/response_writer.h"

#include <boost/asio/buffer.hpp>
#include <chrono>
#include <ctime>

namespace vsplit::rest {
namespace {

std::string http_date() {
    const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
    std::tm utc{};
    gmtime_r(&now, &utc);
    char text[40];  // NOLINT(modernize-avoid-c-arrays): strftime's
    const std::size_t length = std::strftime(text, sizeof text, "%a, %d %b %Y %H:%M:%S GMT", &utc);
    return {text, length};
}

net::const_buffer buffer_of(std::string_view text) { return {text.data(), text.size()}; }

// Not a braced list: g++ 12 goes wrong on those in an awaited expression.
std::vector<net::const_buffer> one(std::string_view text) { return std::vector<net::const_buffer>(1, buffer_of(text)); }

}  // namespace

ResponseWriter::ResponseWriter(beast::tcp_stream& stream, ResponseManner manner, const RestLimits& limits)
    : stream_(stream), manner_(std::move(manner)), limits_(limits) {}

http::response<http::empty_body> ResponseWriter::make_header(const ResponseHead& head) {
    http::response<http::empty_body> header;
    header.version(manner_.version == 10 ? 10 : 11);
    header.result(head.status);
    if (head.status == 499) header.reason("Client Closed Request");
    header.set(http::field::date, http_date());
    for (const auto& [name, value] : manner_.fields) header.insert(name, value);
    for (const auto& [name, value] : head.fields) header.insert(name, value);
    header.set("X-Content-Type-Options", "nosniff");
    has_body_ = !head.content_type.empty();
    if (has_body_) header.set(http::field::content_type, head.content_type);
    if (head.gzip) header.set(http::field::content_encoding, "gzip");
    if (has_body_ && head.length && !head.gzip) {
        header.content_length(*head.length);
    } else if (has_body_ && manner_.version >= 11) {
        chunked_ = true;
        header.chunked(true);
    } else if (has_body_) {
        manner_.keep_alive = false;  // HTTP/1.0 ends such a body by closing
    } else if (head.status != 204 && head.status != 304) {
        header.content_length(0);
    }
    header.keep_alive(manner_.keep_alive);
    return header;
}

Awaitable<bool> ResponseWriter::begin(ResponseHead head) {
    begun_ = true;
    status_ = head.status;
    const http::response<http::empty_body> header = make_header(head);
    if (head.gzip && !manner_.head_only) gzip_ = std::make_unique<Gzip>();
    http::response_serializer<http::empty_body> serializer(header);
    stream_.expires_after(limits_.stall_time);
    ErrorCode failed;
    co_await http::async_write_header(stream_, serializer, into(failed));
    failed_ = failed && failed != http::error::end_of_stream;
    co_return !failed_;
}

Awaitable<bool> ResponseWriter::send(std::vector<net::const_buffer> parts) {
    if (failed_) co_return false;
    // A slow reader is one that takes nothing for a while: however large a part is, it goes out in bits.
    ErrorCode failed;
    std::size_t sent = 0;
    const std::size_t all = net::buffer_size(parts);
    while (sent < all && !failed) {
        stream_.expires_after(limits_.stall_time);
        const std::size_t now = co_await stream_.async_write_some(parts, into(failed));
        sent += now;
        std::size_t skip = now;
        std::size_t gone = 0;
        while (gone < parts.size() && skip >= parts[gone].size()) skip -= parts[gone++].size();
        parts.erase(parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(gone));
        if (!parts.empty()) parts.front() += skip;
    }
    sent_ += sent;
    failed_ = static_cast<bool>(failed);
    co_return !failed_;
}

Awaitable<bool> ResponseWriter::send_chunk(std::vector<net::const_buffer> parts) {
    const std::size_t size = net::buffer_size(parts);
    if (size == 0) co_return !failed_;  // an empty chunk would be the last
    if (!chunked_) co_return co_await send(std::move(parts));
    char digits[20];  // NOLINT(modernize-avoid-c-arrays)
    const int length = std::snprintf(digits, sizeof digits, "%zx\r\n", size);
    parts.insert(parts.begin(), net::const_buffer(digits, static_cast<std::size_t>(length)));
    parts.push_back(buffer_of("\r\n"));
    co_return co_await send(std::move(parts));
}

Awaitable<bool> ResponseWriter::write(std::vector<net::const_buffer> parts) {
    if (manner_.head_only || !has_body_) co_return !failed_;
    if (!gzip_) co_return co_await send_chunk(std::move(parts));
    for (const net::const_buffer& part : parts) {
        const std::string made = gzip_->take({static_cast<const char*>(part.data()), part.size()}, false);
        if (!co_await send_chunk(one(made))) co_return false;
    }
    co_return true;
}

Awaitable<bool> ResponseWriter::write(std::string_view part) { return write(one(part)); }

Awaitable<bool> ResponseWriter::end() {
    if (gzip_) {
        const std::string rest = gzip_->take({}, true);
        if (!co_await send_chunk(one(rest))) co_return false;
    }
    if (chunked_ && !manner_.head_only && !co_await send(one("0\r\n\r\n"))) co_return false;
    whole_ = !failed_;
    co_return whole_;
}

Awaitable<bool> ResponseWriter::respond(ResponseHead head, std::string_view body) {
    head.length = body.size();
    if (!co_await begin(std::move(head))) co_return false;
    if (!co_await write(body)) co_return false;
    co_return co_await end();
}

}  // namespace vsplit::rest
