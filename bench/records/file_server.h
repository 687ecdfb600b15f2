#pragma once

#include <grpcpp/grpcpp.h>

#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include "vsplit/v1/meshing.grpc.pb.h"

namespace vsplit::bench {

/// A server in this process whose DownloadMesh sends one file that is in memory, in parts as large as vsplitd's: so other formats
/// come the way that its own files come.
class FileServer final : public v1::Meshing::Service {
public:
    FileServer(std::string file, std::uint32_t faces) : file_(std::move(file)), faces_(faces) {
        server_ = grpc::ServerBuilder()
                      .AddListeningPort("127.0.0.1:0", grpc::InsecureServerCredentials(), &port_)
                      .RegisterService(this)
                      .BuildAndStart();
    }
    ~FileServer() override { server_->Shutdown(); }

    [[nodiscard]] std::string address() const { return "127.0.0.1:" + std::to_string(port_); }

    grpc::Status DownloadMesh(grpc::ServerContext*, const v1::DownloadMeshRequest*,
                              grpc::ServerWriter<v1::MeshChunk>* writer) override {
        constexpr std::size_t kPart = std::size_t{64} * 1024;
        v1::MeshChunk part;
        part.set_size(file_.size());
        part.set_faces(faces_);
        for (std::size_t at = 0; at < file_.size(); at += kPart) {
            part.set_offset(at);
            part.set_data(file_.substr(at, kPart));
            if (!writer->Write(part)) break;
            part.Clear();
        }
        return grpc::Status::OK;
    }

private:
    const std::string file_;
    const std::uint32_t faces_;
    int port_ = 0;
    std::unique_ptr<grpc::Server> server_;
};

}  // namespace vsplit::bench
