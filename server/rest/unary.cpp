#include <utility>
#include <variant>

#include "rest/handlers.h"

namespace vsplit::rest {
namespace pb = google::protobuf;

Awaitable<void> serve_unary(Exchange& exchange, const Route& route, const Target& target, Tools tools) {
    if (!accepts_json(exchange)) co_return co_await exchange.fail(not_acceptable(kJsonType));
    auto request = co_await read_request(exchange, route, target, tools.json);
    if (auto* problem = std::get_if<Problem>(&request)) co_return co_await exchange.fail(*problem);
    const auto& message = *std::get<std::unique_ptr<pb::Message>>(request);
    const Expected<grpc::ByteBuffer> reply =
        co_await tools.rpcs.call(exchange, *route.rpc, message, RpcClient::WhenLeft::kCancel);
    if (!reply) co_return co_await exchange.fail(problem_of(reply.error()));
    const std::unique_ptr<pb::Message> response = tools.json.schema.new_message(route.rpc->output_type());
    const Status parsed = from_buffer(*reply, *response);
    if (!parsed) co_return co_await exchange.fail(problem_of(parsed.error()));
    co_await respond_json(exchange, *response, tools.json);
}

}  // namespace vsplit::rest
