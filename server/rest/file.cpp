#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "rest/accept.h"
#include "rest/byte_range.h"
#include "rest/conditions.h"
#include "rest/freshness.h"
#include "rest/handlers.h"
#include "rest/message_shape.h"
#include "wire/describe_file.h"

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
        return std::string(type.empty() ? kBytesType : type);
    }
    [[nodiscard]] std::string digest() { return std::string(text(shape_.digest, scratch_)); }
    [[nodiscard]] std::uint64_t size() const {
        return shape_.size == nullptr ? 0 : chunk_->GetReflection()->GetUInt64(*chunk_, shape_.size);
    }

    /// No more is wanted than what came; a file that came whole ends by itself.
    Awaitable<void> give_up(bool whole) {
        std::optional<grpc::ByteBuffer> more;
        if (whole) more = co_await call_->read();
        if (!whole || more) call_->cancel();
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

// What is sent of a file, and as what.
struct Answer {
    std::string type;
    Freshness freshness;
    ByteRange range;
    bool gzip = false;
};

// A part is of the file as it is: what gzip makes of it has no parts. Ranges are GET's alone.
Answer plan(const Exchange& exchange, FileStream& file, std::string type) {
    Answer answer{std::move(type), {"", "private, no-cache", "Accept, Accept-Encoding"}, {}, false};
    const std::string digest = file.digest();
    const std::string plain = digest.empty() ? "" : entity_tag(digest, "");
    if (exchange.method() == "GET" && range_holds(exchange.header(http::field::if_range), plain)) {
        answer.range = parse_range(exchange.header(http::field::range), file.size());
    }
    answer.gzip =
        answer.range.kind == ByteRange::Kind::kWhole && accepts_encoding(exchange.list(http::field::accept_encoding), "gzip");
    answer.freshness.etag = answer.gzip && !digest.empty() ? entity_tag(digest, "gzip") : plain;
    return answer;
}

ResponseHead head_of(FileStream& file, const Answer& answer) {
    ResponseHead head;
    head.content_type = answer.type;
    if (file.size() > 0) head.length = file.size();
    head.gzip = answer.gzip;
    head.fields = fields_of(answer.freshness);
    if (!file.file_name().empty()) head.fields.emplace_back("Content-Disposition", disposition(file.file_name()));
    head.fields.emplace_back("Accept-Ranges", "bytes");
    if (answer.range.kind == ByteRange::Kind::kPart) {
        const std::string first = std::to_string(answer.range.first);
        const std::string last = std::to_string(answer.range.last);
        head.status = 206;
        head.length = answer.range.last - answer.range.first + 1;
        head.fields.emplace_back("Content-Range", "bytes " + first + '-' + last + '/' + std::to_string(file.size()));
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

Problem behind_the_end(std::uint64_t size) {
    Problem problem =
        http_problem(416, Cause::kInvalidOption,
                     "the range begins behind the end of the file, which has " + std::to_string(size) + " bytes", "Range");
    problem.content_range = "bytes */" + std::to_string(size);
    return problem;
}

// True when nothing more is to come of the file.
Awaitable<bool> send_file(Exchange& exchange, FileStream& file, const Answer& answer) {
    const bool begun = co_await exchange.response().begin(head_of(file, answer));
    bool whole = begun;
    if (begun && !exchange.response().head_only()) whole = co_await send_bytes(exchange, file, answer.range);
    if (whole) {
        co_await exchange.response().end();
    } else {
        exchange.response().close_after();
    }
    co_return whole&& answer.range.kind == ByteRange::Kind::kWhole && !exchange.response().head_only();
}

// The type to send the file as; empty where the client takes none and has been told.
Awaitable<std::string> choose_type(Exchange& exchange, FileStream& file) {
    const std::string own = file.content_type();
    const std::array<std::string_view, 2> offers{own, kBytesType};
    const std::string accept = exchange.list(http::field::accept);
    const std::optional<std::size_t> offer = choose_media_type(accept, offers);
    if (offer) co_return std::string(offers[*offer]);
    const std::string offered = own == kBytesType ? own : own + " and " + std::string(kBytesType);
    co_await exchange.fail(not_acceptable(offered));
    co_return std::string();
}

// Whether the request was answered without a byte of the file.
Awaitable<bool> answer_without_bytes(Exchange& exchange, FileStream& file, const Answer& answer) {
    bool answered = co_await answer_condition(exchange, answer.freshness);
    if (!answered && answer.range.kind == ByteRange::Kind::kUnsatisfiable) {
        const Problem problem = behind_the_end(file.size());
        co_await exchange.fail(problem);
        answered = true;
    }
    co_return answered;
}

// True when nothing more is to come of the file.
Awaitable<bool> answer_with(Exchange& exchange, FileStream& file) {
    const std::string type = co_await choose_type(exchange, file);
    if (type.empty()) co_return false;
    const Answer answer = plan(exchange, file, type);
    const bool answered = co_await answer_without_bytes(exchange, file, answer);
    if (answered) co_return false;
    co_return co_await send_file(exchange, file, answer);
}

RpcCall::Metadata only_description() { return {{wire::kDescribeFileKey, "1"}}; }

bool is_conditional(const Exchange& exchange) {
    return !exchange.header(http::field::if_match).empty() || !exchange.header(http::field::if_none_match).empty();
}

// Whether what is known of a file may be all that the answer needs.
bool asks_first(const Exchange& exchange) {
    return exchange.method() == "HEAD" || is_conditional(exchange) || !exchange.header(http::field::range).empty();
}

// Whether a description was enough for an answer. Of a file that was not made yet its type is known and no more, which is enough
// for a HEAD without conditions: it may leave out what only the making tells (RFC 9110 9.3.2).
Awaitable<bool> answer_by_description(Exchange& exchange, FileStream& file) {
    const std::string type = co_await choose_type(exchange, file);
    if (type.empty()) co_return true;
    const Answer answer = plan(exchange, file, type);
    const bool known = file.size() > 0;
    bool answered = false;
    if (known) answered = co_await answer_without_bytes(exchange, file, answer);
    const bool head_is_enough = exchange.method() == "HEAD" && (known || !is_conditional(exchange));
    if (!answered && head_is_enough) {
        co_await send_file(exchange, file, answer);
        answered = true;
    }
    co_return answered;
}

// Begins the rpc with the request.
Awaitable<std::shared_ptr<RpcCall>> ask_for(Exchange& exchange, const Route& route, const pb::Message& request, Tools tools,
                                            const RpcCall::Metadata& more) {
    const std::shared_ptr<RpcCall> call = tools.rpcs.start(exchange, *route.rpc, more);
    cancel_when_left(exchange, call);
    co_await call->write(to_buffer(request), true);
    co_return call;
}

Awaitable<void> fail_without_file(Exchange& exchange, FileStream& file) {
    const grpc::Status status = co_await file.finish();
    Problem problem = problem_of(Error{Cause::kInternal, "the stream ended without a chunk", ""});
    if (!status.ok()) problem = problem_of(status);
    co_await exchange.fail(problem);
}

}  // namespace

Awaitable<void> serve_file(Exchange& exchange, const Route& route, const Target& target, Tools tools) {
    auto read = co_await read_request(exchange, route, target, tools.json);
    if (auto* problem = std::get_if<Problem>(&read)) co_return co_await exchange.fail(*problem);
    const pb::Message& request = *std::get<std::unique_ptr<pb::Message>>(read);
    if (asks_first(exchange)) {
        const RpcCall::Metadata describe = only_description();
        const std::shared_ptr<RpcCall> call = co_await ask_for(exchange, route, request, tools, describe);
        FileStream description(call, tools.json.schema, *route.rpc->output_type());
        if (!co_await description.next()) co_return co_await fail_without_file(exchange, description);
        const bool answered = co_await answer_by_description(exchange, description);
        co_await description.give_up(true);
        if (answered) co_return;
    }
    const net::any_io_executor executor = exchange.executor();
    const std::shared_ptr<Turns::Turn> turn = co_await tools.files.take(target.path, executor);
    const RpcCall::Metadata nothing;
    const std::shared_ptr<RpcCall> call = co_await ask_for(exchange, route, request, tools, nothing);
    FileStream file(call, tools.json.schema, *route.rpc->output_type());
    const bool begun = co_await file.next();
    turn->end();
    if (!begun) co_return co_await fail_without_file(exchange, file);
    const bool to_the_end = co_await answer_with(exchange, file);
    co_await file.give_up(to_the_end);
}

}  // namespace vsplit::rest
