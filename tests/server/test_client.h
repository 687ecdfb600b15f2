#pragma once

#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "vsplit/base/error.h"
#include "vsplit/io/mesh_format.h"
#include "vsplit/mesh/triangle_mesh.h"
#include "vsplit/mrr/progressive_mesh.h"
#include "vsplit/v1/meshing.grpc.pb.h"

/// What tests say to a server.
namespace vsplit::test {

using Stub = v1::Meshing::Stub;

/// A call's context with a deadline, so that no test waits for ever.
[[nodiscard]] std::unique_ptr<grpc::ClientContext> call(std::chrono::milliseconds deadline = std::chrono::seconds(120));

/// The channel once it is connected. A call on one that is not yet fails where its first attempt does, and gRPC 1.51 has been
/// seen to give one up for an errno that is none of connect()'s ("No such file or directory").
std::shared_ptr<grpc::Channel> connected(std::shared_ptr<grpc::Channel> channel);

/// Whether the status carries this cause and field in its google.rpc details, and a message.
[[nodiscard]] ::testing::AssertionResult failed_with(const grpc::Status& status, Cause cause, std::string_view field = "");

/// Calls `done` until it is true or the time is over; whether it became true.
[[nodiscard]] bool eventually(const std::function<bool()>& done, std::chrono::milliseconds within = std::chrono::seconds(20));

/// Exactly the mesh: binary PLY.
[[nodiscard]] std::string file_of(const TriangleMesh& mesh, MeshFormat format = MeshFormat::kPlyBinary);

/// A reply or what kept it from coming.
template <class Message>
struct Reply {
    grpc::Status status;
    Message message;
};

[[nodiscard]] Reply<v1::Session> create_session(Stub& stub, const std::string& file = "", double weld = 0);
[[nodiscard]] Reply<v1::Session> get_session(Stub& stub, const std::string& session);
[[nodiscard]] Reply<v1::ListSessionsResponse> list_sessions(Stub& stub, std::uint32_t page_size = 0,
                                                            const std::string& token = "");
[[nodiscard]] grpc::Status delete_session(Stub& stub, const std::string& session);
[[nodiscard]] Reply<v1::Quality> get_quality(Stub& stub, const std::string& session, const std::string& representation = "",
                                             std::uint32_t faces = 0, std::uint32_t worst = 0);

/// The id of a new session with this mesh; the test fails when there is none.
[[nodiscard]] std::string session_with(Stub& stub, const TriangleMesh& mesh);

/// Streams the file in parts of `part_bytes`, its size declared.
[[nodiscard]] Reply<v1::Session> upload(Stub& stub, const std::string& session, const std::string& file,
                                        std::size_t part_bytes = 1000);

/// Streams exactly these messages.
[[nodiscard]] Reply<v1::Session> upload_parts(Stub& stub, const std::vector<v1::UploadMeshRequest>& parts);

/// All that a stream of events brought, its mesh rebuilt.
struct Received {
    grpc::Status status;
    std::vector<v1::Progress> progress;
    std::optional<ProgressiveMesh> mesh;  ///< refined by every record; the client's own to begin with
    std::size_t base_parts = 0;
    std::size_t records = 0;
    std::optional<v1::Representation> representation;
};

using EventReader = grpc::ClientReader<v1::ProgressiveEvent>;

/// Reads to the end. Fails the test where events come in a wrong order, are damaged, or do not fit the mesh.
[[nodiscard]] Received receive(EventReader& reader, std::optional<ProgressiveMesh> held = std::nullopt);

[[nodiscard]] Received improve(Stub& stub, const v1::ImproveRequest& request);
[[nodiscard]] Received control(Stub& stub, const v1::ControlRequest& request);
[[nodiscard]] Received set_resolution(Stub& stub, const v1::SetResolutionRequest& request,
                                      std::optional<ProgressiveMesh> held = std::nullopt);

/// An Improve of a few thousand faces on a mesh of diagonal 2 to 4.
[[nodiscard]] v1::ImproveRequest small_improve(const std::string& session);

/// An Improve that would take many seconds on the unit sphere.
[[nodiscard]] v1::ImproveRequest long_improve(const std::string& session);

/// A downloaded file and what its first chunk said.
struct Downloaded {
    grpc::Status status;
    v1::MeshChunk first;
    std::string file;
};

/// Reads to the end. Fails the test where chunks are out of order or too large.
[[nodiscard]] Downloaded download(Stub& stub, const v1::DownloadMeshRequest& request);
[[nodiscard]] Downloaded download(Stub& stub, const std::string& session, const std::string& representation = "",
                                  std::uint32_t faces = 0, v1::MeshFormat format = v1::PLY);

/// A method that a test has begun and not ended.
class RunningImprove {
public:
    RunningImprove(Stub& stub, const v1::ImproveRequest& request, std::chrono::milliseconds deadline = std::chrono::seconds(120));
    ~RunningImprove();

    /// Reads until the method waits ("queued") or works (anything else); false when the stream ended before.
    [[nodiscard]] bool wait_until_queued();
    [[nodiscard]] bool wait_until_working();

    void cancel() { context_->TryCancel(); }

    /// Reads to the end.
    [[nodiscard]] grpc::Status finish();

private:
    const std::unique_ptr<grpc::ClientContext> context_;
    std::unique_ptr<EventReader> reader_;
    bool finished_ = false;
};

}  // namespace vsplit::test
