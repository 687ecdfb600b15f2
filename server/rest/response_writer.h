#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rest/asio.h"
#include "rest/background.h"
#include "rest/gzip.h"
#include "rest/header_fields.h"
#include "rest/rest_options.h"
#include "rest/stream.h"

namespace vsplit::rest {

/// What stands before an answer's body.
struct ResponseHead {
    unsigned status = 200;
    std::string content_type;             ///< empty for an answer that has no body
    std::optional<std::uint64_t> length;  ///< of the body; empty for one that ends when it ends
    HeaderFields fields;
    bool gzip = false;  ///< makes the length unknown
};

/// What of the request decides how an answer is written.
struct ResponseManner {
    unsigned version = 11;
    bool keep_alive = true;
    bool head_only = false;
    HeaderFields fields;               ///< of every answer, CORS's for example
    Background* background = nullptr;  ///< for what is heavy; none for answers that never are
};

/// Bytes that are written one after another.
using Parts = std::vector<net::const_buffer>;

/// Writes the answer to one request, part by part; each part is with the operating system before the next is asked for.
class ResponseWriter {
public:
    ResponseWriter(Stream& stream, ResponseManner manner, const RestLimits& limits);

    [[nodiscard]] bool begun() const { return begun_; }
    [[nodiscard]] unsigned status() const { return status_; }
    [[nodiscard]] std::uint64_t sent() const { return sent_; }
    [[nodiscard]] bool head_only() const { return manner_.head_only; }

    /// The connection is closed after this answer.
    void close_after() { manner_.keep_alive = false; }

    /// Whether the connection may serve another request: the answer is whole and nobody has asked to close.
    [[nodiscard]] bool keeps_alive() const { return whole_ && manner_.keep_alive; }

    // All return false when the client is gone or takes nothing; nothing is written any more then.

    Awaitable<bool> begin(const ResponseHead& head);
    Awaitable<bool> write(const Parts& parts);
    Awaitable<bool> write(std::string_view part);
    Awaitable<bool> end();

    /// The whole of a short answer.
    Awaitable<bool> respond(const ResponseHead& head, std::string_view body);

private:
    [[nodiscard]] http::response<http::empty_body> make_header(const ResponseHead& head);
    Awaitable<bool> send(const Parts& parts);
    Awaitable<bool> send_chunk(const Parts& parts);
    Awaitable<bool> send_compressed(std::string_view part);

    Stream& stream_;
    ResponseManner manner_;
    const RestLimits& limits_;
    std::unique_ptr<Gzip> gzip_;
    unsigned status_ = 0;
    std::uint64_t sent_ = 0;
    bool begun_ = false;
    bool chunked_ = false;
    bool has_body_ = false;
    bool failed_ = false;
    bool whole_ = false;
};

}  // namespace vsplit::rest
