#include "grpc/rpc_meter.h"

#include <google/protobuf/message.h>
#include <grpcpp/support/byte_buffer.h>

#include <string>

#include "vsplit/v1/meshing.grpc.pb.h"

namespace vsplit::rpc {
namespace {

using grpc::experimental::InterceptionHookPoints;
using grpc::experimental::InterceptorBatchMethods;
using grpc::experimental::ServerRpcInfo;

// One an rpc.
class Interceptor final : public grpc::experimental::Interceptor {
public:
    Interceptor(RpcMeter& meter, std::string_view name) : meter_(meter), name_(name) {
        const std::string ours = std::string("/") + v1::Meshing::service_full_name() + '/';
        name_.remove_prefix(1);
        is_ours_ = name.substr(0, ours.size()) == ours;
        if (is_ours_) name_ = name.substr(ours.size());
        meter_.rpc_began(name_);
    }

    void Intercept(InterceptorBatchMethods* methods) override {
        if (methods->QueryInterceptionHookPoint(InterceptionHookPoints::POST_RECV_MESSAGE)) count_in(methods->GetRecvMessage());
        if (methods->QueryInterceptionHookPoint(InterceptionHookPoints::PRE_SEND_MESSAGE))
            count_out(methods->GetSerializedSendMessage());
        if (methods->QueryInterceptionHookPoint(InterceptionHookPoints::PRE_SEND_STATUS)) {
            meter_.rpc_ended(name_, methods->GetSendStatus().error_code(), std::chrono::steady_clock::now() - start_);
        }
        methods->Proceed();
    }

private:
    // Null when the client has no more to send. Only of our own rpcs is it known what the pointer is.
    void count_in(const void* message) {
        if (message == nullptr || !is_ours_) return;
        meter_.message_in(static_cast<const google::protobuf::Message*>(message)->ByteSizeLong());
    }

    void count_out(const grpc::ByteBuffer* message) {
        if (message != nullptr) meter_.message_out(message->Length());
    }

    RpcMeter& meter_;
    std::string_view name_;  // of the server's own list of methods
    bool is_ours_ = false;
    const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

class Factory final : public grpc::experimental::ServerInterceptorFactoryInterface {
public:
    explicit Factory(RpcMeter& meter) : meter_(meter) {}

    grpc::experimental::Interceptor* CreateServerInterceptor(ServerRpcInfo* info) override {
        return new Interceptor(meter_, info->method());
    }

private:
    RpcMeter& meter_;
};

}  // namespace

InterceptorFactories interceptors_of(RpcMeter& meter) {
    InterceptorFactories factories;
    factories.push_back(std::make_unique<Factory>(meter));
    return factories;
}

}  // namespace vsplit::rpc
