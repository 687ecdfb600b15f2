#include "rest/response_writer.h"

#include <boost/asio/buffer.hpp>
#include <chrono>
#include <ctime>
#include <sstream>

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

Parts one(std::string_view text) { return Parts(1, buffer_of(text)); }

std::string chunk_length(std::size_t size) {
    std::ostringstream text;
    text << std::hex << size << "\r\n";
    return text.str();
}

}  // namespace

ResponseWriter::ResponseWriter(Stream& stream, ResponseManner manner, const RestLimits& limits)
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
    } else if (has_body_ && manner_.head_only && !head.gzip) {
        // the length of a body that has not been made is left out
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

Awaitable<bool> ResponseWriter::begin(const ResponseHead& head) {
    begun_ = true;
    status_ = head.status;
    const http::response<http::empty_body> header = make_header(head);
    if (head.gzip && !manner_.head_only) gzip_ = std::make_unique<Gzip>();
    http::response_serializer<http::empty_body> serializer(header);
    stream_.expires_after(limits_.patience.stall);
    ErrorCode failed;
    co_await http::async_write_header(stream_, serializer, into(failed));
    failed_ = failed && failed != http::error::end_of_stream;
    co_return !failed_;
}

Awaitable<bool> ResponseWriter::send(const Parts& all_parts) {
    if (failed_) co_return false;
    Parts parts = all_parts;
    // A slow reader is one that takes nothing for a while: however large a part is, it goes out in bits.
    ErrorCode failed;
    std::size_t sent = 0;
    const std::size_t all = net::buffer_size(parts);
    while (sent < all && !failed) {
        stream_.expires_after(limits_.patience.stall);
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

Awaitable<bool> ResponseWriter::send_chunk(const Parts& parts) {
    const std::size_t size = net::buffer_size(parts);
    if (size == 0) co_return !failed_;  // an empty chunk would be the last
    if (!chunked_) co_return co_await send(parts);
    const std::string length = chunk_length(size);
    Parts framed = one(length);
    framed.insert(framed.end(), parts.begin(), parts.end());
    framed.push_back(buffer_of("\r\n"));
    co_return co_await send(framed);
}

Awaitable<bool> ResponseWriter::write(const Parts& parts) {
    if (manner_.head_only || !has_body_) co_return !failed_;
    if (!gzip_) co_return co_await send_chunk(parts);
    for (const net::const_buffer& part : parts) {
        const std::string_view text(static_cast<const char*>(part.data()), part.size());
        const bool sent = co_await send_compressed(text);
        if (!sent) co_return false;
    }
    co_return true;
}

Awaitable<bool> ResponseWriter::send_compressed(std::string_view part) {
    const auto compress = [this, part] { return gzip_->take(part, false); };
    std::string made;
    if (manner_.background == nullptr || part.size() < kMoment) {
        made = compress();
    } else {
        made = co_await manner_.background->run(compress);
    }
    const Parts parts = one(made);
    co_return co_await send_chunk(parts);
}

Awaitable<bool> ResponseWriter::write(std::string_view part) {
    const Parts parts = one(part);
    co_return co_await write(parts);
}

Awaitable<bool> ResponseWriter::end() {
    if (gzip_) {
        const std::string rest = gzip_->take({}, true);
        const Parts parts = one(rest);
        co_await send_chunk(parts);
    }
    if (chunked_ && !manner_.head_only) {
        const Parts last = one("0\r\n\r\n");
        co_await send(last);
    }
    whole_ = !failed_;
    co_return whole_;
}

Awaitable<bool> ResponseWriter::respond(const ResponseHead& head, std::string_view body) {
    ResponseHead whole = head;
    whole.length = body.size();
    bool going = co_await begin(whole);
    if (going) going = co_await write(body);
    if (going) going = co_await end();
    co_return going;
}

}  // namespace vsplit::rest
