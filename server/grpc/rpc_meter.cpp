#include "grpc/rpc_meter.h"

#include <google/protobuf/message.h>
#include <grpcpp/server_context.h>
#include <grpcpp/support/byte_buffer.h>

#include "grpc/method_name.h"

namespace vsplit::rpc {
namespace {

using grpc::experimental::InterceptionHookPoints;
using grpc::experimental::InterceptorBatchMethods;
using grpc::experimental::ServerRpcInfo;

// One an rpc.
class Interceptor final : public grpc::experimental::Interceptor {
public:
    Interceptor(RpcMeter& meter, ServerRpcInfo& rpc) : meter_(meter), rpc_(rpc), name_(method_name(rpc.method())) {
        meter_.rpc_began(name_.text);
    }

    void Intercept(InterceptorBatchMethods* methods) override {
        if (methods->QueryInterceptionHookPoint(InterceptionHookPoints::POST_RECV_MESSAGE)) count_in(methods->GetRecvMessage());
        if (methods->QueryInterceptionHookPoint(InterceptionHookPoints::PRE_SEND_MESSAGE))
            count_out(methods->GetSerializedSendMessage());
        if (methods->QueryInterceptionHookPoint(InterceptionHookPoints::PRE_SEND_STATUS)) {
            meter_.rpc_ended(name_.text, code_of(methods->GetSendStatus()), std::chrono::steady_clock::now() - start_);
        }
        methods->Proceed();
    }

private:
    // gRPC's own health service says UNKNOWN where a client leaves, and that would be taken for a fault of the server.
    grpc::StatusCode code_of(const grpc::Status& status) {
        const bool left = status.error_code() == grpc::StatusCode::UNKNOWN && !is_ours() && rpc_.server_context()->IsCancelled();
        return left ? grpc::StatusCode::CANCELLED : status.error_code();
    }

    [[nodiscard]] bool is_ours() const { return name_.kind == MethodName::Kind::kContract; }

    // Null when the client has no more to send. Only of our own rpcs is it known what the pointer is.
    void count_in(const void* message) {
        if (message == nullptr || !is_ours()) return;
        meter_.message_in(static_cast<const google::protobuf::Message*>(message)->ByteSizeLong());
    }

    void count_out(const grpc::ByteBuffer* message) {
        if (message != nullptr) meter_.message_out(message->Length());
    }

    RpcMeter& meter_;
    ServerRpcInfo& rpc_;
    const MethodName name_;
    const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

class Factory final : public grpc::experimental::ServerInterceptorFactoryInterface {
public:
    explicit Factory(RpcMeter& meter) : meter_(meter) {}

    grpc::experimental::Interceptor* CreateServerInterceptor(ServerRpcInfo* info) override {
        return new Interceptor(meter_, *info);
    }

private:
    RpcMeter& meter_;
};

}  // namespace

std::unique_ptr<grpc::experimental::ServerInterceptorFactoryInterface> interceptor_of(RpcMeter& meter) {
    return std::make_unique<Factory>(meter);
}

}  // namespace vsplit::rpc
