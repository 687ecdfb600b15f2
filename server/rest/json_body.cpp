#include "rest/json_body.h"

#include <algorithm>
#include <array>
#include <utility>

#include "rest/accept.h"
#include "rest/request_fields.h"
#include "service/limits.h"
#include "wire/json.h"
#include "wire/utf8.h"

namespace vsplit::rest {
namespace pb = google::protobuf;

namespace {

// Worth compressing.
constexpr std::size_t kLong = 1400;

Problem too_large(const RestLimits& limits) {
    return http_problem(413, Cause::kLimitExceeded,
                        "the JSON body is larger than " + std::to_string(limits.json_bytes) +
                            " bytes, the server's limit; a mesh is sent as it is, not in JSON");
}

Error too_many_now() {
    return {Cause::kLimitExceeded, "the server holds as many JSON bodies as it has memory for", "", service::kRetryAfter};
}

// What is made of one, at most: in protobuf's messages here and in the rpc, and on the way between them. A list of {} takes many
// times the bytes of its text.
constexpr std::uint64_t kBytesOfMessage = 320;
constexpr std::uint64_t kBytesOfValue = 32;
// The text, and the same with longer names: "m" becomes "METRE".
constexpr std::uint64_t kTextsWhereRespelled = 3;

// Holds the memory that will be taken. \return LIMIT_EXCEEDED.
Status hold_what_is_made(const wire::JsonSize& size, std::uint64_t text_bytes, std::uint64_t limit, JsonShare& share) {
    const std::uint64_t texts = size.respelled ? kTextsWhereRespelled * text_bytes : text_bytes;
    const std::uint64_t bytes = texts + kBytesOfMessage * size.messages + kBytesOfValue * size.values;
    if (bytes > limit) {
        return Error{Cause::kLimitExceeded,
                     "the JSON body has " + std::to_string(size.messages) + " objects and " + std::to_string(size.values) +
                         " other values, which take about " + std::to_string(bytes) +
                         " bytes; the server's limit json_memory is " + std::to_string(limit),
                     ""};
    }
    return share.hold(bytes) ? Status(Done{}) : Status(too_many_now());
}

using TextOrProblem = std::variant<std::string, Problem>;

Awaitable<TextOrProblem> read_text(Exchange& exchange, JsonShare& share) {
    const RestLimits& limits = exchange.limits();
    const std::optional<std::uint64_t> declared = exchange.body().declared_size();
    if (declared.value_or(0) > limits.json_bytes) co_return too_large(limits);
    std::string text;
    for (;;) {
        // Taken as it comes, not as it is announced: a client that only claims much holds nothing.
        constexpr std::size_t kPart = std::size_t{64} * 1024;
        const std::size_t room = std::min<std::uint64_t>(kPart, declared.value_or(limits.json_bytes + 1) - text.size());
        const std::size_t before = text.size();
        if (!share.hold(before + room)) co_return problem_of(too_many_now());
        text.resize(before + room);
        const Expected<std::size_t> got = co_await exchange.body().read_some({text.data() + before, room});
        if (!got) co_return problem_of(got.error());
        text.resize(before + *got);
        if (text.size() > limits.json_bytes) co_return too_large(limits);
        if (*got == 0 || exchange.body().at_end()) co_return text;
    }
}

// The message that the body is: the request or one of its fields.
pb::Message* body_message(const Route& route, pb::Message& request) {
    if (route.body == "*") return &request;
    const pb::FieldDescriptor* const field = request.GetDescriptor()->FindFieldByName(route.body);
    if (field->cpp_type() != pb::FieldDescriptor::CPPTYPE_MESSAGE || field->is_repeated()) return nullptr;
    return request.GetReflection()->MutableMessage(&request, field);
}

Status take_body(const Route& route, const std::string& text, pb::Message& request, const wire::AdmitJson& admit) {
    constexpr auto kRefused = wire::UnknownFields::kRefused;
    if (pb::Message* const message = body_message(route, request)) return wire::from_json(text, *message, kRefused, admit);
    return wire::from_json('{' + std::string("\"") + route.body + "\":" + text + '}', request, kRefused, admit);
}

bool is_json(std::string_view type) { return same_token(media_type(type), kJsonType); }

Problem too_large_a_message(std::size_t bytes, std::uint64_t limit) {
    return problem_of(Error{Cause::kLimitExceeded,
                            "this body makes a message of " + std::to_string(bytes) +
                                " bytes; the server's limit max_message_bytes is " + std::to_string(limit) +
                                ". A mesh of any size is taken as it is: curl -T FILE",
                            ""});
}

}  // namespace

Status bind_target(const Route& route, const Target& target, pb::Message& request) {
    for (const QueryParameter& parameter : target.query) {
        if (Status set = set_field(request, parameter.name, parameter.value); !set) return set;
    }
    const auto variables = route.path.match(target.path);
    for (const PathVariable& variable : *variables) {
        if (Status set = set_field(request, variable.field, variable.value); !set) return set;
    }
    return Done{};
}

Awaitable<std::variant<std::unique_ptr<pb::Message>, Problem>> read_request(Exchange& exchange, const Route& route,
                                                                            const Target& target, JsonWorks works) {
    std::unique_ptr<pb::Message> request = works.schema.new_message(route.rpc->input_type());
    JsonShare share(works.budget);
    TextOrProblem read = co_await read_text(exchange, share);
    if (auto* problem = std::get_if<Problem>(&read)) co_return std::move(*problem);
    const std::string& text = std::get<std::string>(read);
    if (!text.empty()) {
        if (route.body.empty()) {
            co_return http_problem(400, Cause::kMalformedInput, "this request takes no body; its options go into the query");
        }
        const std::string_view type = exchange.header(http::field::content_type);
        if (!type.empty() && !is_json(type)) co_return wrong_body_type(exchange, kJsonType);
        if (std::optional<Problem> coded = refuse_coding(exchange)) co_return *std::move(coded);
        const auto admit = [&](const wire::JsonSize& size) {
            return hold_what_is_made(size, text.size(), exchange.limits().json_memory, share);
        };
        const auto parse = [&] { return take_body(route, text, *request, admit); };
        Status parsed = Done{};
        if (text.size() < kMoment) {
            parsed = parse();
        } else {
            parsed = co_await works.background.run(parse);
        }
        if (!parsed) co_return problem_of(parsed.error());
    }
    const Status bound = bind_target(route, target, *request);
    if (!bound) co_return problem_of(bound.error());
    const std::size_t made = request->ByteSizeLong();
    if (made > exchange.limits().message_bytes) co_return too_large_a_message(made, exchange.limits().message_bytes);
    co_return std::move(request);
}

Awaitable<std::string> write_json(const pb::Message& message, JsonWorks works) {
    const auto write = [&message] { return wire::to_json(message) + '\n'; };
    if (message.ByteSizeLong() < kMoment) co_return write();
    co_return co_await works.background.run(write);
}

Awaitable<void> respond_json(Exchange& exchange, const pb::Message& message, JsonWorks works) {
    const std::string text = co_await write_json(message, works);
    ResponseHead head;
    head.content_type = kJsonType;
    head.fields.emplace_back("Cache-Control", "no-store");
    head.fields.emplace_back("Vary", "Accept, Accept-Encoding");
    head.gzip = text.size() > kLong && accepts_encoding(exchange.list(http::field::accept_encoding), "gzip");
    co_await exchange.response().respond(head, text);
}

bool accepts_json(const Exchange& exchange) {
    constexpr std::array kOffers{kJsonType};
    return choose_media_type(exchange.list(http::field::accept), kOffers).has_value();
}

Problem not_acceptable(std::string_view offered) {
    return http_problem(406, Cause::kUnsupported, "nothing that Accept names is offered here; offered is " + std::string(offered),
                        "Accept");
}

std::optional<Problem> refuse_coding(const Exchange& exchange) {
    const std::string_view coding = exchange.header(http::field::content_encoding);
    if (coding.empty() || same_token(coding, "identity")) return std::nullopt;
    return http_problem(415, Cause::kUnsupported, "the body has a Content-Encoding; accepted is the body as it is",
                        "Content-Encoding");
}

Problem wrong_body_type(const Exchange& exchange, std::string_view accepted) {
    constexpr std::size_t kQuoted = 100;
    const std::string_view type = media_type(exchange.header(http::field::content_type));
    return http_problem(
        415, Cause::kUnsupported,
        "the body's Content-Type is \"" + wire::valid_utf8(type, kQuoted) + "\"; accepted is " + std::string(accepted),
        "Content-Type");
}

}  // namespace vsplit::rest
