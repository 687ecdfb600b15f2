#include <google/protobuf/descriptor.h>
#include <google/protobuf/io/coded_stream.h>

#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "google/rpc/status.pb.h"
#include "rest/accept.h"
#include "rest/handlers.h"
#include "rest/message_shape.h"
#include "wire/error_table.h"
#include "wire/json.h"

namespace vsplit::rest {
namespace pb = google::protobuf;

namespace {

constexpr std::array<std::string_view, 3> kOffers{kJsonType, "application/x-ndjson", "application/x-vsplit"};
constexpr std::string_view kOffered = "application/json, application/x-ndjson and application/x-vsplit";

// How the events of one rpc are told.
class EventWriter {
public:
    EventWriter(Exchange& exchange, const pb::Descriptor& type, Tools tools) : exchange_(exchange), type_(type), tools_(tools) {}
    virtual ~EventWriter() = default;
    EventWriter(const EventWriter&) = delete;
    EventWriter& operator=(const EventWriter&) = delete;

    /// False when the client is gone.
    virtual Awaitable<bool> take(const grpc::ByteBuffer& event) = 0;
    virtual Awaitable<void> finish(const grpc::Status& status) = 0;

protected:
    Awaitable<bool> begin(std::string_view content_type) {
        if (exchange_.response().begun()) co_return true;
        ResponseHead head;
        head.content_type = content_type;
        head.fields.emplace_back("Cache-Control", "no-store");
        head.fields.emplace_back("Vary", "Accept, Accept-Encoding");
        co_return co_await exchange_.response().begin(head);
    }

    [[nodiscard]] Expected<std::unique_ptr<pb::Message>> parse(const grpc::ByteBuffer& buffer) const {
        std::unique_ptr<pb::Message> event = tools_.json.schema.new_message(&type_);
        if (Status parsed = from_buffer(buffer, *event); !parsed) return parsed.error();
        return event;
    }

    // The field of the event's oneof that is set; null where the message is made another way.
    [[nodiscard]] static const pb::FieldDescriptor* kind_of(const pb::Message& event) {
        const pb::OneofDescriptor* const oneof = sole_oneof(*event.GetDescriptor());
        return oneof == nullptr ? nullptr : event.GetReflection()->GetOneofFieldDescriptor(event, oneof);
    }

    Exchange& exchange_;          // NOLINT(cppcoreguidelines-non-private-member-variables-in-classes)
    const pb::Descriptor& type_;  // NOLINT(cppcoreguidelines-non-private-member-variables-in-classes)
    const Tools tools_;           // NOLINT(cppcoreguidelines-non-private-member-variables-in-classes)
};

// application/json: the last event's content, once it is there.
class LastEvent final : public EventWriter {
public:
    using EventWriter::EventWriter;

    Awaitable<bool> take(const grpc::ByteBuffer& event) override {
        last_ = event;  // shares its slices
        co_return true;
    }

    Awaitable<void> finish(const grpc::Status& status) override {
        if (!status.ok()) co_return co_await exchange_.fail(problem_of(status));
        if (!last_) co_return co_await exchange_.fail(problem_of({Cause::kInternal, "the stream ended without an event", ""}));
        const auto event = parse(*last_);
        if (!event) co_return co_await exchange_.fail(problem_of(event.error()));
        const pb::FieldDescriptor* const kind = kind_of(**event);
        const bool wrapped = kind != nullptr && kind->cpp_type() == pb::FieldDescriptor::CPPTYPE_MESSAGE;
        const pb::Message& content = wrapped ? (*event)->GetReflection()->GetMessage(**event, kind) : **event;
        co_await respond_json(exchange_, content, tools_.json);
    }

private:
    std::optional<grpc::ByteBuffer> last_;
};

// application/x-ndjson: an event a line, without those that carry bytes; an error is the last line.
class EventLines final : public EventWriter {
public:
    using EventWriter::EventWriter;

    Awaitable<bool> take(const grpc::ByteBuffer& buffer) override {
        const auto event = parse(buffer);
        if (!event) co_return false;
        const pb::FieldDescriptor* const kind = kind_of(**event);
        if (kind != nullptr && kind->message_type() != nullptr && has_bytes(*kind->message_type())) co_return true;
        if (!co_await begin(kOffers[1])) co_return false;
        const std::string line = co_await write_json(**event, tools_.json);
        co_return co_await exchange_.response().write(line);
    }

    Awaitable<void> finish(const grpc::Status& status) override {
        if (!status.ok() && !exchange_.response().begun()) co_return co_await exchange_.fail(problem_of(status));
        if (!co_await begin(kOffers[1])) co_return;
        if (!status.ok()) {
            std::string problem = problem_json(problem_of(status));
            problem.pop_back();  // its own end of line
            const std::string line = "{\"error\":" + problem + "}\n";
            if (!co_await exchange_.response().write(line)) co_return;
        }
        co_await exchange_.response().end();
    }
};

// application/x-vsplit: every event as it came, its length before it as a varint.
class EventFrames final : public EventWriter {
public:
    using EventWriter::EventWriter;

    Awaitable<bool> take(const grpc::ByteBuffer& event) override {
        if (!co_await begin(kOffers[2])) co_return false;
        std::array<std::uint8_t, 10> varint{};
        const std::uint8_t* const end = pb::io::CodedOutputStream::WriteVarint64ToArray(event.Length(), varint.data());
        std::vector<grpc::Slice> slices;
        static_cast<void>(event.Dump(&slices));
        std::vector<net::const_buffer> parts(1, net::const_buffer(varint.data(), static_cast<std::size_t>(end - varint.data())));
        for (const grpc::Slice& slice : slices) parts.emplace_back(slice.begin(), slice.size());
        co_return co_await exchange_.response().write(parts);
    }

    Awaitable<void> finish(const grpc::Status& status) override {
        if (!status.ok() && !exchange_.response().begun()) co_return co_await exchange_.fail(problem_of(status));
        bool going = co_await begin(kOffers[2]);
        if (going && !status.ok()) going = co_await tell(status);
        if (going) co_await exchange_.response().end();
    }

private:
    // As an event of its own, where the message has one for that; else the answer is cut off.
    Awaitable<bool> tell(const grpc::Status& status) {
        const std::unique_ptr<pb::Message> event = tools_.json.schema.new_message(&type_);
        const pb::FieldDescriptor* const field = type_.FindFieldByName("error");
        if (field == nullptr || field->message_type() == nullptr ||
            field->message_type()->full_name() != google::rpc::Status::descriptor()->full_name()) {
            co_await exchange_.fail(problem_of(status));
            co_return false;
        }
        // By its bytes: the schema's google.rpc.Status is another class than the generated one.
        const std::string bytes = wire::to_status(wire::from_status(status)).error_details();
        event->GetReflection()->MutableMessage(event.get(), field)->ParseFromString(bytes);
        co_return co_await take(to_buffer(*event));
    }
};

std::unique_ptr<EventWriter> make_writer(std::size_t offer, Exchange& exchange, const pb::Descriptor& type, Tools tools) {
    if (offer == 1) return std::make_unique<EventLines>(exchange, type, tools);
    if (offer == 2) return std::make_unique<EventFrames>(exchange, type, tools);
    return std::make_unique<LastEvent>(exchange, type, tools);
}

}  // namespace

Awaitable<void> serve_events(Exchange& exchange, const Route& route, const Target& target, Tools tools) {
    const std::optional<std::size_t> offer = choose_media_type(exchange.list(http::field::accept), kOffers);
    if (!offer) co_return co_await exchange.fail(not_acceptable(kOffered));
    auto request = co_await read_request(exchange, route, target, tools.json);
    if (auto* problem = std::get_if<Problem>(&request)) co_return co_await exchange.fail(*problem);
    const std::unique_ptr<EventWriter> writer = make_writer(*offer, exchange, *route.rpc->output_type(), tools);
    const std::shared_ptr<RpcCall> call = tools.rpcs.start(exchange, *route.rpc);
    cancel_when_left(exchange, call);
    co_await call->write(to_buffer(*std::get<std::unique_ptr<pb::Message>>(request)), true);
    std::get<std::unique_ptr<pb::Message>>(request).reset();  // a method may run for an hour
    while (std::optional<grpc::ByteBuffer> event = co_await call->read()) {
        const bool going = co_await writer->take(*event);
        if (going) continue;
        call->cancel();
        break;
    }
    const grpc::Status status = co_await call->finish();
    co_await writer->finish(status);
}

}  // namespace vsplit::rest
