#include "grpc/grpc_server.h"

#include <grpcpp/ext/proto_server_reflection_plugin.h>
#include <grpcpp/health_check_service_interface.h>

#include <utility>

namespace vsplit::rpc {
namespace {

// For the last words of rpcs that have ended to reach their clients.
constexpr std::chrono::milliseconds kFlushTime{200};

}  // namespace

GrpcServer::GrpcServer(service::MeshingService& service, RpcObserver observer)
    : ledger_(std::move(observer)), rpcs_(service, ledger_) {}

GrpcServer::~GrpcServer() { shutdown(std::chrono::milliseconds(0)); }

Expected<std::unique_ptr<GrpcServer>> GrpcServer::start(const std::string& address, service::MeshingService& service,
                                                        const GrpcExtras& extras) {
    std::unique_ptr<GrpcServer> server(new GrpcServer(service, extras.observer));
    if (Status listening = server->listen(address, extras); !listening) return listening.error();
    return server;
}

Status GrpcServer::listen(const std::string& address, const GrpcExtras& extras) {
    grpc::EnableDefaultHealthCheckService(true);
    grpc::reflection::InitProtoReflectionServerBuilderPlugin();
    grpc::ServerBuilder builder;
    // Otherwise two servers could share a port, and each get some of the other's rpcs.
    builder.AddChannelArgument(GRPC_ARG_ALLOW_REUSEPORT, 0);
    builder.SetMaxReceiveMessageSize(kMaxMessageBytes);
    builder.AddListeningPort(address, grpc::InsecureServerCredentials(), &port_);
    builder.RegisterService(&rpcs_);
    for (grpc::Service* service : extras.services) builder.RegisterService(service);
    if (extras.meter != nullptr) builder.experimental().SetInterceptorCreators(interceptors_of(*extras.meter));
    server_ = builder.BuildAndStart();
    if (server_ == nullptr || port_ == 0) return Error{Cause::kUnavailable, "cannot listen on " + address, "listen"};
    server_->GetHealthCheckService()->SetServingStatus(v1::Meshing::service_full_name(), true);
    return Done{};
}

std::shared_ptr<grpc::Channel> GrpcServer::channel() {
    grpc::ChannelArguments arguments;
    arguments.SetMaxReceiveMessageSize(-1);  // what the server itself makes needs no limit
    return server_->InProcessChannel(arguments);
}

void GrpcServer::drain(std::chrono::milliseconds grace) {
    if (server_ == nullptr) return;
    server_->GetHealthCheckService()->SetServingStatus(false);
    // gRPC would wait for idle connections too, and many clients keep theirs until they call again.
    ledger_.close();
    ledger_.wait_until_idle(grace);
}

void GrpcServer::shutdown(std::chrono::milliseconds grace) {
    if (server_ == nullptr) return;
    drain(grace);
    server_->Shutdown(std::chrono::system_clock::now() + kFlushTime);
    server_->Wait();
    server_.reset();
}

}  // namespace vsplit::rpc
