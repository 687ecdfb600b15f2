#include <chrono>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "rest/accept.h"
#include "rest/handlers.h"
#include "rest/message_shape.h"
#include "wire/field.h"

namespace vsplit::rest {
namespace pb = google::protobuf;

namespace {

constexpr std::chrono::milliseconds kRefusalTime{10};
constexpr std::size_t kPartBytes = std::size_t{256} * 1024;

// Types that say a body is something else than a file as it is.
constexpr std::string_view kMultipart = "multipart/form-data";

std::optional<Problem> refuse_body(const Exchange& exchange) {
    const std::string_view type = media_type(exchange.header(http::field::content_type));
    if (same_token(type, kJsonType) || same_token(type, kMultipart)) {
        return wrong_body_type(exchange, "the file as it is (curl -T FILE), as application/octet-stream or any other type");
    }
    // A client that takes up an upload that broke off would have the rest of its file taken for the whole.
    if (!exchange.header(http::field::content_range).empty()) {
        return http_problem(400, Cause::kMalformedInput,
                            "a part of a file is no mesh; accepted is the whole, without Content-Range", "Content-Range");
    }
    return refuse_coding(exchange);
}

// A body on its way into an rpc that takes chunks.
class Uploader {
public:
    Uploader(Exchange& exchange, const pb::MethodDescriptor& rpc, Tools tools)
        : exchange_(exchange), call_(tools.rpcs.start(exchange, rpc)), shape_(*ChunkShape::of(*rpc.input_type())) {}

    /// Sends everything; the reply, or why there is none. `chunk` holds what the first message is to say beside its bytes.
    Awaitable<Expected<grpc::ByteBuffer>> run(pb::Message& chunk) {
        Expected<bool> sent = co_await send(chunk);
        if (!sent) {
            call_->cancel();
            co_await call_->finish();
            co_return sent.error();
        }
        if (*sent) {
            cancel_when_left(exchange_, call_);  // the body is here: nobody reads from the client meanwhile
            co_await call_->writes_done();
        }
        co_return co_await reply_of(*call_);
    }

private:
    // False when the rpc is over before the body is, which tells why by its status.
    Awaitable<Expected<bool>> send(pb::Message& chunk) {
        const pb::Reflection& reflection = *chunk.GetReflection();
        const std::optional<std::uint64_t> size = exchange_.body().declared_size();
        if (shape_.size != nullptr && size) reflection.SetUInt64(&chunk, shape_.size, *size);
        if (!co_await call_->write(to_buffer(chunk), false)) co_return false;
        chunk.Clear();
        // An empty part more: it is taken when the first one has been accepted or refused, and only then a client that waits is
        // told to go on. The news of a refusal comes a moment later; where it does not, the client has sent for nothing.
        if (exchange_.body().client_waits()) {
            const bool taken = co_await call_->write(to_buffer(chunk), false);
            if (!taken) co_return false;
            const bool refused = co_await call_->over_within(kRefusalTime);
            if (refused) co_return false;
        }
        std::vector<char> part(kPartBytes);
        for (;;) {
            const std::uint64_t offset = exchange_.body().received();
            const Expected<std::size_t> got = co_await exchange_.body().read_some(part);
            if (!got) co_return got.error();
            if (*got == 0) co_return true;
            reflection.SetUInt64(&chunk, shape_.offset, offset);
            reflection.SetString(&chunk, shape_.data, std::string(part.data(), *got));
            if (!co_await call_->write(to_buffer(chunk), false)) co_return false;
        }
    }

    Exchange& exchange_;
    const std::shared_ptr<RpcCall> call_;
    const ChunkShape shape_;
};

constexpr std::string_view kCreate = "vsplit.v1.Meshing.CreateSession";
constexpr const char* kUpload = "vsplit.v1.Meshing.UploadMesh";
constexpr const char* kSession = "session";
constexpr const char* kDelete = "vsplit.v1.Meshing.DeleteSession";

std::string text_of(const pb::Message& message, const char* field) {
    return message.GetReflection()->GetString(message, message.GetDescriptor()->FindFieldByName(field));
}

void set_session(pb::Message& message, const std::string& session) {
    message.GetReflection()->SetString(&message, message.GetDescriptor()->FindFieldByName(kSession), session);
}

Awaitable<Expected<std::string>> create_empty(Exchange& exchange, const pb::MethodDescriptor& create, Tools tools) {
    const auto request = tools.json.schema.new_message(create.input_type());
    const Expected<grpc::ByteBuffer> reply = co_await tools.rpcs.call(exchange, create, *request, RpcClient::WhenLeft::kGoOn);
    if (!reply) co_return reply.error();
    const auto session = tools.json.schema.new_message(create.output_type());
    if (Status parsed = from_buffer(*reply, *session); !parsed) co_return parsed.error();
    co_return text_of(*session, "id");
}

// Whether it is gone. A limit on what is done at a time may be in the way for a moment.
Awaitable<bool> delete_session(Exchange& exchange, const std::string& session, Tools tools) {
    const pb::MethodDescriptor& rpc = *tools.json.schema.find_rpc(kDelete);
    const auto request = tools.json.schema.new_message(rpc.input_type());
    set_session(*request, session);
    const auto deleted = co_await tools.rpcs.call(exchange, rpc, *request, RpcClient::WhenLeft::kGoOn);
    co_return deleted || deleted.error().retry_after == 0;
}

// Where that fails again and again the session expires.
Awaitable<void> delete_later(Exchange& exchange, const std::string& session, Tools tools) {
    constexpr int kTimes = 5;
    constexpr std::chrono::seconds kPause(1);
    net::steady_timer timer(exchange.executor());
    for (int i = 0; i < kTimes; ++i) {
        ErrorCode ignored;
        timer.expires_after(kPause);
        co_await timer.async_wait(into(ignored));
        const bool gone = co_await delete_session(exchange, session, tools);
        if (gone) co_return;
    }
}

Awaitable<void> respond(Exchange& exchange, const pb::Descriptor* type, const Expected<grpc::ByteBuffer>& reply, Tools tools) {
    if (!reply) co_return co_await exchange.fail(problem_of(reply.error()));
    const std::unique_ptr<pb::Message> response = tools.json.schema.new_message(type);
    const Status parsed = from_buffer(*reply, *response);
    if (!parsed) co_return co_await exchange.fail(problem_of(parsed.error()));
    co_await respond_json(exchange, *response, tools.json);
}

}  // namespace

Awaitable<void> serve_upload(Exchange& exchange, const Route& route, const Target& target, Tools tools) {
    if (!accepts_json(exchange)) co_return co_await exchange.fail(not_acceptable(kJsonType));
    if (std::optional<Problem> refused = refuse_body(exchange)) co_return co_await exchange.fail(*refused);
    const auto first = tools.json.schema.new_message(route.rpc->input_type());
    const Status bound = bind_target(route, target, *first);
    if (!bound) co_return co_await exchange.fail(problem_of(bound.error()));
    const Expected<grpc::ByteBuffer> reply = co_await Uploader(exchange, *route.rpc, tools).run(*first);
    co_await respond(exchange, route.rpc->output_type(), reply, tools);
}

bool takes_mesh_body(const pb::MethodDescriptor& rpc) { return rpc.full_name() == kCreate; }

bool creates_with_mesh(Exchange& exchange, const Route& route) {
    const std::string_view type = exchange.header(http::field::content_type);
    if (!takes_mesh_body(*route.rpc) || same_token(media_type(type), kJsonType)) return false;
    return !type.empty() || exchange.body().declared_size() != 0U;  // a file may be empty by mistake
}

Awaitable<void> serve_create_with_mesh(Exchange& exchange, const Route& route, const Target& target, Tools tools) {
    if (!accepts_json(exchange)) co_return co_await exchange.fail(not_acceptable(kJsonType));
    if (std::optional<Problem> refused = refuse_body(exchange)) co_return co_await exchange.fail(*refused);
    const pb::MethodDescriptor& upload = *tools.json.schema.find_rpc(kUpload);
    const auto first = tools.json.schema.new_message(upload.input_type());
    const Status bound = bind_target(route, target, *first);
    if (!bound) co_return co_await exchange.fail(problem_of(bound.error()));
    if (!text_of(*first, kSession).empty()) {
        const Error unknown = wire::unknown_field(kSession, *route.rpc->input_type());
        co_return co_await exchange.fail(problem_of(unknown));
    }
    const Expected<std::string> session = co_await create_empty(exchange, *route.rpc, tools);
    if (!session) co_return co_await exchange.fail(problem_of(session.error()));
    set_session(*first, *session);
    const Expected<grpc::ByteBuffer> reply = co_await Uploader(exchange, upload, tools).run(*first);
    bool there = reply.has_value();
    if (!there) there = !co_await delete_session(exchange, *session, tools);
    co_await respond(exchange, upload.output_type(), reply, tools);
    if (there && !reply) co_await delete_later(exchange, *session, tools);
}

}  // namespace vsplit::rest
