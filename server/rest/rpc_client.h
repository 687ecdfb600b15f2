#pragma once

#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>
#include <grpcpp/generic/generic_stub.h>
#include <grpcpp/grpcpp.h>

#include <memory>
#include <utility>

#include "rest/exchange.h"
#include "rest/rpc_call.h"
#include "vsplit/base/expected.h"

namespace vsplit::rest {

/// Calls the rpcs behind REST, on behalf of who sent a request: its credentials go along.
class RpcClient {
public:
    explicit RpcClient(std::shared_ptr<grpc::Channel> channel) : stub_(std::move(channel)) {}
    ~RpcClient() { live_.wait_for_none(); }
    RpcClient(const RpcClient&) = delete;
    RpcClient& operator=(const RpcClient&) = delete;

    /// Begins an rpc; `more` is metadata for it alone.
    [[nodiscard]] std::shared_ptr<RpcCall> start(Exchange& exchange, const google::protobuf::MethodDescriptor& rpc,
                                                 RpcCall::Metadata more = {});

    enum class WhenLeft { kCancel, kGoOn };

    /// One message there, one back. \pre the body has been read, where the rpc is to be cancelled when the client leaves.
    Awaitable<Expected<grpc::ByteBuffer>> call(Exchange& exchange, const google::protobuf::MethodDescriptor& rpc,
                                               const google::protobuf::Message& request, WhenLeft when_left);

private:
    grpc::GenericStub stub_;
    LiveCalls live_;
};

/// The one reply of an rpc that has been sent everything, or its error.
Awaitable<Expected<grpc::ByteBuffer>> reply_of(RpcCall& call);

/// Cancels `call` when the client of `exchange` leaves, from now to the end of the exchange. \pre the body has been read.
void cancel_when_left(Exchange& exchange, const std::shared_ptr<RpcCall>& call);

[[nodiscard]] grpc::ByteBuffer to_buffer(const google::protobuf::Message& message);

/// \return CORRUPT for bytes that are no such message.
[[nodiscard]] Status from_buffer(const grpc::ByteBuffer& buffer, google::protobuf::Message& message);

}  // namespace vsplit::rest
