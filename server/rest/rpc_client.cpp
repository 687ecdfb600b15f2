#include "rest/rpc_client.h"

#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "wire/error_table.h"
#include "wire/trace_context.h"

namespace vsplit::rest {
namespace pb = google::protobuf;

std::shared_ptr<RpcCall> RpcClient::start(Exchange& exchange, const pb::MethodDescriptor& rpc, RpcCall::Metadata more) {
    RpcCall::Metadata metadata = std::move(more);
    const std::string_view credentials = exchange.header(http::field::authorization);
    if (!credentials.empty()) metadata.emplace("authorization", credentials);
    const RequestMark& mark = exchange.mark();
    metadata.emplace(wire::kRequestIdKey, mark.id);
    metadata.emplace(wire::kTraceparentKey, wire::to_traceparent(mark.trace));
    metadata.emplace(wire::kForwardedPeerKey, mark.peer);
    return RpcCall::start(stub_, '/' + rpc.service()->full_name() + '/' + rpc.name(), metadata, live_, exchange.executor());
}

Awaitable<Expected<grpc::ByteBuffer>> RpcClient::call(Exchange& exchange, const pb::MethodDescriptor& rpc,
                                                      const pb::Message& request, WhenLeft when_left) {
    const std::shared_ptr<RpcCall> call = start(exchange, rpc);
    if (when_left == WhenLeft::kCancel) cancel_when_left(exchange, call);
    co_await call->write(to_buffer(request), true);
    co_return co_await reply_of(*call);
}

Awaitable<Expected<grpc::ByteBuffer>> reply_of(RpcCall& call) {
    std::optional<grpc::ByteBuffer> reply = co_await call.read();
    if (reply) co_await call.read();  // the end
    const grpc::Status status = co_await call.finish();
    if (!status.ok()) co_return wire::from_status(status);
    if (!reply) co_return Error{Cause::kInternal, "the rpc ended without a reply", ""};
    co_return *std::move(reply);
}

void cancel_when_left(Exchange& exchange, const std::shared_ptr<RpcCall>& call) {
    exchange.leave_watch().start([weak = std::weak_ptr<RpcCall>(call)] {
        if (const std::shared_ptr<RpcCall> running = weak.lock()) running->cancel();
    });
}

grpc::ByteBuffer to_buffer(const pb::Message& message) {
    grpc::Slice slice(message.ByteSizeLong());
    // What a slice that was just made holds is ours alone to write.
    message.SerializeToArray(const_cast<std::uint8_t*>(slice.begin()), static_cast<int>(slice.size()));
    return {&slice, 1};
}

Status from_buffer(const grpc::ByteBuffer& buffer, pb::Message& message) {
    grpc::Slice slice;
    const bool whole = buffer.TrySingleSlice(&slice).ok() || buffer.DumpToSingleSlice(&slice).ok();
    if (whole && slice.size() <= static_cast<std::size_t>(std::numeric_limits<int>::max()) &&
        message.ParseFromArray(slice.begin(), static_cast<int>(slice.size()))) {
        return Done{};
    }
    return Error{Cause::kCorrupt, "the rpc's reply is no " + message.GetDescriptor()->full_name(), ""};
}

}  // namespace vsplit::rest
