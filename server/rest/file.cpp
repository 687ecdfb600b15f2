#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "rest/accept.h"
#include "rest/byte_range.h"
#include "rest/handlers.h"
#include "rest/message_shape.h"
#include "wire/error_table.h"

namespace vsplit::rest {
namespace pb = google::protobuf;

namespace {

// A stream of chunks as a file: what its first message tells of the whole, and its bytes.
class FileStream {
public:
    FileStream(std::shared_ptr<RpcCall> call, const Schema& schema, const pb::Descriptor& type)
        : call_(std::move(call)), shape_(*ChunkShape::of(type)), chunk_(schema.new_message(&type)) {}

    /// Goes to the next chunk; false at the end, and where a chunk is none.
    Awaitable<bool> next() {
        const std::optional<grpc::ByteBuffer> buffer = co_await call_->read();
        co_return buffer&& from_buffer(*buffer, *chunk_);
    }

    [[nodiscard]] std::string_view data() { return text(shape_.data, data_); }
    [[nodiscard]] std::string_view file_name() { return text(shape_.file_name, scratch_); }
    [[nodiscard]] std::string content_type() {
        const std::string_view type = text(shape_.content_type, scratch_);
        return type.empty() ? "application/octet-stream" : std::string(type);
    }
    [[nodiscard]] std::uint64_t size() const {
        return shape_.size == nullptr ? 0 : chunk_->GetReflection()->GetUInt64(*chunk_, shape_.size);
    }

    /// No more is wanted than what came; a file that came whole ends by itself.
    Awaitable<void> give_up(bool whole) {
        if (whole) {
            co_await call_->read();
        } else {
            call_->cancel();
        }
        co_await call_->finish();
    }

    Awaitable<grpc::Status> finish() { return call_->finish(); }

private:
    std::string_view text(const pb::FieldDescriptor* field, std::string& scratch) {
        if (field == nullptr) return {};
        return chunk_->GetReflection()->GetStringReference(*chunk_, field, &scratch);
    }

    const std::shared_ptr<RpcCall> call_;
    const ChunkShape shape_;
    const std::unique_ptr<pb::Message> chunk_;
    std::string data_;
    std::string scratch_;
};

// Quotes and what is no visible ASCII would end the name early or smuggle in another field.
std::string disposition(std::string_view name) {
    std::string safe(name);
    std::replace_if(
        safe.begin(), safe.end(), [](char c) { return c < ' ' || c > '~' || c == '"' || c == '\\' || c == '/'; }, '_');
    return "attachment; filename=\"" + safe + '"';
}

ResponseHead head_of(const Exchange& exchange, FileStream& file, const ByteRange& range) {
    ResponseHead head;
    head.content_type = file.content_type();
    head.length = file.size();
    head.fields.emplace_back("Content-Disposition", disposition(file.file_name()));
    head.fields.emplace_back("Accept-Ranges", "bytes");
    head.fields.emplace_back("Cache-Control", "no-store");
    head.fields.emplace_back("Vary", "Accept-Encoding");
    if (range.kind == ByteRange::Kind::kPart) {
        head.status = 206;
        head.length = range.last - range.first + 1;
        head.fields.emplace_back("Content-Range", "bytes " + std::to_string(range.first) + '-' + std::to_string(range.last) +
                                                      '/' + std::to_string(file.size()));
    } else {
        head.gzip = accepts_encoding(exchange.header(http::field::accept_encoding), "gzip");
    }
    return head;
}

// False when the client is gone.
Awaitable<bool> send_bytes(Exchange& exchange, FileStream& file, const ByteRange& range) {
    std::uint64_t at = 0;
    const std::uint64_t end = range.kind == ByteRange::Kind::kPart ? range.last + 1 : file.size();
    bool going = true;
    while (going && at < end) {
        const std::string_view data = file.data();
        const std::uint64_t skip = std::min<std::uint64_t>(data.size(), range.first > at ? range.first - at : 0);
        const std::uint64_t stop = std::min<std::uint64_t>(data.size(), end - at);
        at += data.size();
        if (skip < stop) going = co_await exchange.response().write(data.substr(skip, stop - skip));
        if (going && at < end) going = co_await file.next();
    }
    co_return going;
}

Awaitable<void> send_file(Exchange& exchange, FileStream& file) {
    ByteRange range;
    // If-Range needs a validator, and there is none that would fit: then the whole is what it asks for.
    if (exchange.header(http::field::if_range).empty()) range = parse_range(exchange.header(http::field::range), file.size());
    if (range.kind == ByteRange::Kind::kUnsatisfiable) {
        Problem problem = http_problem(
            416, Cause::kInvalidOption,
            "the range begins behind the end of the file, which has " + std::to_string(file.size()) + " bytes", "Range");
        problem.content_range = "bytes */" + std::to_string(file.size());
        co_await exchange.fail(problem);
        co_return co_await file.give_up(false);
    }
    const bool begun = co_await exchange.response().begin(head_of(exchange, file, range));
    bool whole = false;
    if (begun && exchange.response().head_only()) {
        whole = true;
    } else if (begun) {
        whole = co_await send_bytes(exchange, file, range);
    }
    if (whole) {
        co_await exchange.response().end();
    } else {
        exchange.response().close_after();
    }
    const bool to_the_end = range.kind == ByteRange::Kind::kWhole && !exchange.response().head_only();
    co_await file.give_up(whole && to_the_end);
}

}  // namespace

Awaitable<void> serve_file(Exchange& exchange, const Route& route, const Target& target, Tools tools) {
    auto request = co_await read_request(exchange, route, target, tools.json);
    if (auto* problem = std::get_if<Problem>(&request)) co_return co_await exchange.fail(*problem);
    const std::shared_ptr<RpcCall> call = tools.rpcs.start(exchange, *route.rpc);
    cancel_when_left(exchange, call);
    co_await call->write(to_buffer(*std::get<std::unique_ptr<pb::Message>>(request)), true);
    FileStream file(call, tools.json.schema, *route.rpc->output_type());
    if (co_await file.next()) co_return co_await send_file(exchange, file);
    const grpc::Status status = co_await file.finish();
    Problem problem = problem_of(Error{Cause::kInternal, "the stream ended without a chunk", ""});
    if (!status.ok()) problem = problem_of(status);
    co_await exchange.fail(problem);
}

}  // namespace vsplit::rest
