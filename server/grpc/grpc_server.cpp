#include "grpc/grpc_server.h"

#include <grpcpp/ext/proto_server_reflection_plugin.h>
#include <grpcpp/health_check_service_interface.h>
#include <grpcpp/resource_quota.h>

#include <memory>
#include <utility>
#include <vector>

#include "grpc/door_credentials.h"

namespace vsplit::rpc {
namespace {

// For the last words of rpcs that have ended to reach their clients.
constexpr std::chrono::milliseconds kFlushTime{200};

constexpr int kMs = 1000;
constexpr int kKeepaliveTimeoutMs = 20 * kMs;
constexpr int kMostPingsMs = 10 * kMs;  // a client may ask so often for a sign of life

void set_life(grpc::ServerBuilder& builder, const ConnectionLife& life) {
    builder.AddChannelArgument(GRPC_ARG_HTTP2_MIN_RECV_PING_INTERVAL_WITHOUT_DATA_MS, kMostPingsMs);
    builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_PERMIT_WITHOUT_CALLS, 1);
    builder.AddChannelArgument(GRPC_ARG_SERVER_HANDSHAKE_TIMEOUT_MS, static_cast<int>(life.handshake.count()) * kMs);
    if (life.keepalive.count() > 0) {
        builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_TIME_MS, static_cast<int>(life.keepalive.count()) * kMs);
        builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, kKeepaliveTimeoutMs);
    }
    if (life.age.count() > 0) {
        builder.AddChannelArgument(GRPC_ARG_MAX_CONNECTION_AGE_MS, static_cast<int>(life.age.count()) * kMs);
    }
}

}  // namespace

GrpcServer::GrpcServer(service::MeshingService& service, const GrpcExtras& extras)
    : ledger_(extras.observer, extras.gate, extras.limits.rpcs),
      live_(extras.limits.rpcs, static_cast<std::size_t>(extras.limits.streams)),
      rpcs_(service, ledger_, extras.shelf, extras.patience),
      strangers_(live_, extras.observer, extras.gate, extras.meter),
      credentials_(door_credentials(extras.tls, &strangers_)),
      door_(extras.limits.connections, extras.on_connection_refused) {}

GrpcServer::~GrpcServer() { shutdown(std::chrono::milliseconds(0)); }

Expected<std::unique_ptr<GrpcServer>> GrpcServer::start(const std::string& host, const std::string& port,
                                                        service::MeshingService& service, const GrpcExtras& extras) {
    std::unique_ptr<GrpcServer> server(new GrpcServer(service, extras));
    if (Status listening = server->door_.listen(host, port); !listening) return listening.error();
    if (Status serving = server->serve(extras); !serving) return serving.error();
    return server;
}

Status GrpcServer::serve(const GrpcExtras& extras) {
    grpc::EnableDefaultHealthCheckService(true);
    grpc::reflection::InitProtoReflectionServerBuilderPlugin();
    grpc::ServerBuilder builder;
    builder.SetMaxReceiveMessageSize(extras.limits.message_bytes);
    builder.SetResourceQuota(grpc::ResourceQuota("vsplitd").Resize(extras.limits.message_memory));
    builder.AddChannelArgument(GRPC_ARG_MAX_CONCURRENT_STREAMS, extras.limits.streams);
    set_life(builder, extras.life);
    using Connections = grpc::ServerBuilder::experimental_type::ExternalConnectionType;
    acceptor_ = builder.experimental().AddExternalConnectionAcceptor(Connections::FROM_FD, credentials_);
    builder.RegisterService(&rpcs_);
    for (grpc::Service* service : extras.services) builder.RegisterService(service);
    std::vector<std::unique_ptr<grpc::experimental::ServerInterceptorFactoryInterface>> interceptors;
    interceptors.push_back(live_.counter());
    if (extras.meter != nullptr) interceptors.push_back(interceptor_of(*extras.meter));
    builder.experimental().SetInterceptorCreators(std::move(interceptors));
    server_ = builder.BuildAndStart();
    if (server_ == nullptr) return Error{Cause::kUnavailable, "gRPC could not start", "listen"};
    server_->GetHealthCheckService()->SetServingStatus(v1::Meshing::service_full_name(), true);
    door_.open([this](int descriptor, int listener) {
        grpc::experimental::ExternalConnectionAcceptor::NewConnectionParameters connection;
        connection.listener_fd = listener;
        connection.fd = descriptor;
        acceptor_->HandleNewConnection(&connection);
    });
    return Done{};
}

std::shared_ptr<grpc::Channel> GrpcServer::channel() {
    grpc::ChannelArguments arguments;
    arguments.SetMaxReceiveMessageSize(-1);  // what the server itself makes needs no limit
    return server_->InProcessChannel(arguments);
}

bool GrpcServer::drain(std::chrono::milliseconds grace) {
    if (server_ == nullptr) return true;
    server_->GetHealthCheckService()->SetServingStatus(false);
    // gRPC would wait for idle connections too, and many clients keep theirs until they call again.
    ledger_.close();
    return ledger_.wait_until_idle(grace);
}

void GrpcServer::shutdown(std::chrono::milliseconds grace) {
    if (server_ == nullptr) return;
    drain(grace);
    door_.close();
    server_->Shutdown(std::chrono::system_clock::now() + kFlushTime);
    server_->Wait();
    server_.reset();
}

}  // namespace vsplit::rpc
