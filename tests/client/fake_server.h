#pragma once

#include <grpcpp/server.h>
#include <grpcpp/server_builder.h>

#include <functional>
#include <memory>
#include <string>

#include "vsplit/v1/meshing.grpc.pb.h"

namespace vsplit::test {

/// A server on loopback that answers what a test tells it to; what it is not told is UNIMPLEMENTED.
class FakeServer final : public v1::Meshing::Service {
public:
    using EventWriter = grpc::ServerWriter<v1::ProgressiveEvent>;

    std::function<grpc::Status(v1::Session&)> on_create;
    std::function<grpc::Status(const std::string&, v1::Session&)> on_get;
    std::function<grpc::Status(grpc::ServerContext&, grpc::ServerReader<v1::UploadMeshRequest>&, v1::Session&)> on_upload;
    std::function<grpc::Status(grpc::ServerContext&, const v1::ImproveRequest&, EventWriter&)> on_improve;
    std::function<grpc::Status(const v1::DownloadMeshRequest&, grpc::ServerWriter<v1::MeshChunk>&)> on_download;

    /// Begins to serve; `target()` says where.
    void start() {
        grpc::ServerBuilder builder;
        builder.AddListeningPort("127.0.0.1:0", grpc::InsecureServerCredentials(), &port_);
        builder.RegisterService(this);
        server_ = builder.BuildAndStart();
    }

    [[nodiscard]] std::string target() const { return "127.0.0.1:" + std::to_string(port_); }

    void stop() {
        if (server_) server_->Shutdown(std::chrono::system_clock::now());
        server_.reset();
    }

    ~FakeServer() override { stop(); }

    grpc::Status CreateSession(grpc::ServerContext*, const v1::CreateSessionRequest*, v1::Session* session) override {
        return on_create ? on_create(*session) : unimplemented();
    }
    grpc::Status GetSession(grpc::ServerContext*, const v1::GetSessionRequest* request, v1::Session* session) override {
        return on_get ? on_get(request->session(), *session) : unimplemented();
    }
    grpc::Status UploadMesh(grpc::ServerContext* context, grpc::ServerReader<v1::UploadMeshRequest>* reader,
                            v1::Session* session) override {
        return on_upload ? on_upload(*context, *reader, *session) : unimplemented();
    }
    grpc::Status Improve(grpc::ServerContext* context, const v1::ImproveRequest* request, EventWriter* writer) override {
        return on_improve ? on_improve(*context, *request, *writer) : unimplemented();
    }
    grpc::Status DownloadMesh(grpc::ServerContext*, const v1::DownloadMeshRequest* request,
                              grpc::ServerWriter<v1::MeshChunk>* writer) override {
        return on_download ? on_download(*request, *writer) : unimplemented();
    }

private:
    static grpc::Status unimplemented() { return {grpc::StatusCode::UNIMPLEMENTED, "not told"}; }

    int port_ = 0;
    std::unique_ptr<grpc::Server> server_;
};

}  // namespace vsplit::test
