#include "test_client.h"

#include <algorithm>
#include <thread>
#include <utility>

#include "google/rpc/status.pb.h"
#include "vsplit/io/write_mesh.h"
#include "wire/base_mesh.h"
#include "wire/convert.h"
#include "wire/error_table.h"

namespace vsplit::test {
namespace {

/// Puts the events of one stream together, and complains of what is wrong.
class Receiver {
public:
    explicit Receiver(std::optional<ProgressiveMesh> held) { received_.mesh = std::move(held); }

    void take(const v1::ProgressiveEvent& event) {
        EXPECT_FALSE(received_.representation) << "the representation is the last word";
        switch (event.event_case()) {
            case v1::ProgressiveEvent::kProgress:
                return take(event.progress());
            case v1::ProgressiveEvent::kBaseMesh:
                return take(event.base_mesh());
            case v1::ProgressiveEvent::kRecordBlock:
                return take(event.record_block());
            case v1::ProgressiveEvent::kRegions:
                EXPECT_TRUE(received_.mesh && received_.records == 0) << "regions come after the base mesh and before records";
                EXPECT_LE(event.regions().ids().size(), wire::kMaxPartBytes);
                return;
            case v1::ProgressiveEvent::kRepresentation:
                received_.representation = event.representation();
                return;
            case v1::ProgressiveEvent::kError:
            case v1::ProgressiveEvent::EVENT_NOT_SET:
                ADD_FAILURE() << "an event that gRPC does not have";
        }
    }

    Received finish(const grpc::Status& status) {
        received_.status = status;
        return std::move(received_);
    }

private:
    void take(const v1::Progress& progress) {
        EXPECT_EQ(received_.base_parts, 0U) << "progress comes before the mesh";
        EXPECT_GE(progress.fraction(), 0);
        EXPECT_LE(progress.fraction(), 1);
        received_.progress.push_back(progress);
    }

    void take(const v1::BaseMesh& part) {
        EXPECT_EQ(received_.records, 0U) << "the base mesh comes before the records";
        EXPECT_LE(part.positions().size() + part.indices().size(), wire::kMaxPartBytes);
        ++received_.base_parts;
        const Status added = base_.add(part);
        ASSERT_TRUE(added) << added.error().message;
        if (!base_.complete()) return;
        Expected<ProgressiveMesh> mesh = ProgressiveMesh::from_base(base_.take(), base_.ghosts());
        ASSERT_TRUE(mesh) << mesh.error().message;
        received_.mesh = *std::move(mesh);
    }

    void take(const v1::RecordBlock& proto) {
        ASSERT_TRUE(received_.mesh) << "records without a mesh";
        EXPECT_LE(proto.payload().size(), kMaxBlockBytes);
        EXPECT_EQ(proto.first(), received_.mesh->records());
        const Expected<RecordBlock> block = wire::from_proto(proto);
        ASSERT_TRUE(block) << block.error().message;
        const Expected<RecordList> records = decode_block(*block);
        ASSERT_TRUE(records) << records.error().message;
        const Status refined = received_.mesh->refine(*records);
        ASSERT_TRUE(refined) << refined.error().message;
        received_.records += records->size();
    }

    Received received_;
    wire::BaseMeshAssembler base_;
};

}  // namespace

std::shared_ptr<grpc::Channel> connected(std::shared_ptr<grpc::Channel> channel) {
    EXPECT_TRUE(channel->WaitForConnected(std::chrono::system_clock::now() + std::chrono::seconds(20)));
    return channel;
}

std::unique_ptr<grpc::ClientContext> call(std::chrono::milliseconds deadline) {
    auto context = std::make_unique<grpc::ClientContext>();
    context->set_deadline(std::chrono::system_clock::now() + deadline);
    return context;
}

::testing::AssertionResult failed_with(const grpc::Status& status, Cause cause, std::string_view field) {
    if (status.ok()) return ::testing::AssertionFailure() << "it succeeded";
    google::rpc::Status details;
    if (status.error_details().empty() || !details.ParseFromString(status.error_details()) || details.details().empty()) {
        return ::testing::AssertionFailure() << "no details: " << status.error_code() << ' ' << status.error_message();
    }
    const Error error = wire::from_status(status);
    if (error.cause == cause && error.field == field && !error.message.empty()) return ::testing::AssertionSuccess();
    return ::testing::AssertionFailure() << cause_name(error.cause) << " in field \"" << error.field << "\": " << error.message;
}

bool eventually(const std::function<bool()>& done, std::chrono::milliseconds within) {
    const auto until = std::chrono::steady_clock::now() + within;
    while (!done()) {
        if (std::chrono::steady_clock::now() > until) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return true;
}

std::string file_of(const TriangleMesh& mesh, MeshFormat format) { return write_mesh(mesh, format); }

Reply<v1::Session> create_session(Stub& stub, const std::string& file, double weld) {
    v1::CreateSessionRequest request;
    request.set_mesh(file);
    request.set_weld(weld);
    Reply<v1::Session> reply;
    reply.status = stub.CreateSession(call().get(), request, &reply.message);
    return reply;
}

Reply<v1::Session> get_session(Stub& stub, const std::string& session) {
    v1::GetSessionRequest request;
    request.set_session(session);
    Reply<v1::Session> reply;
    reply.status = stub.GetSession(call().get(), request, &reply.message);
    return reply;
}

Reply<v1::ListSessionsResponse> list_sessions(Stub& stub, std::uint32_t page_size, const std::string& token) {
    v1::ListSessionsRequest request;
    request.set_page_size(page_size);
    request.set_page_token(token);
    Reply<v1::ListSessionsResponse> reply;
    reply.status = stub.ListSessions(call().get(), request, &reply.message);
    return reply;
}

grpc::Status delete_session(Stub& stub, const std::string& session) {
    v1::DeleteSessionRequest request;
    request.set_session(session);
    google::protobuf::Empty empty;
    return stub.DeleteSession(call().get(), request, &empty);
}

Reply<v1::Quality> get_quality(Stub& stub, const std::string& session, const std::string& representation, std::uint32_t faces,
                               std::uint32_t worst) {
    v1::GetQualityRequest request;
    request.set_session(session);
    request.set_representation(representation);
    request.set_faces(faces);
    request.set_worst(worst);
    Reply<v1::Quality> reply;
    reply.status = stub.GetQuality(call().get(), request, &reply.message);
    return reply;
}

std::string session_with(Stub& stub, const TriangleMesh& mesh) {
    const Reply<v1::Session> created = create_session(stub, file_of(mesh));
    EXPECT_TRUE(created.status.ok()) << created.status.error_message();
    return created.message.id();
}

Reply<v1::Session> upload(Stub& stub, const std::string& session, const std::string& file, std::size_t part_bytes) {
    std::vector<v1::UploadMeshRequest> parts;
    for (std::size_t at = 0; at < file.size() || parts.empty(); at += part_bytes) {
        v1::UploadMeshRequest& part = parts.emplace_back();
        part.set_offset(at);
        part.set_data(file.substr(at, part_bytes));
    }
    parts.front().set_session(session);
    parts.front().set_size(file.size());
    return upload_parts(stub, parts);
}

Reply<v1::Session> upload_parts(Stub& stub, const std::vector<v1::UploadMeshRequest>& parts) {
    Reply<v1::Session> reply;
    const std::unique_ptr<grpc::ClientContext> context = call();
    const auto writer = stub.UploadMesh(context.get(), &reply.message);
    for (const v1::UploadMeshRequest& part : parts) {
        if (!writer->Write(part)) break;  // the status says why
    }
    writer->WritesDone();
    reply.status = writer->Finish();
    return reply;
}

Received receive(EventReader& reader, std::optional<ProgressiveMesh> held) {
    Receiver receiver(std::move(held));
    v1::ProgressiveEvent event;
    while (reader.Read(&event)) receiver.take(event);
    return receiver.finish(reader.Finish());
}

Received improve(Stub& stub, const v1::ImproveRequest& request) {
    const std::unique_ptr<grpc::ClientContext> context = call();
    return receive(*stub.Improve(context.get(), request));
}

Received control(Stub& stub, const v1::ControlRequest& request) {
    const std::unique_ptr<grpc::ClientContext> context = call();
    return receive(*stub.Control(context.get(), request));
}

Received set_resolution(Stub& stub, const v1::SetResolutionRequest& request, std::optional<ProgressiveMesh> held) {
    const std::unique_ptr<grpc::ClientContext> context = call();
    return receive(*stub.SetResolution(context.get(), request), std::move(held));
}

v1::ImproveRequest small_improve(const std::string& session) {
    v1::ImproveRequest request;
    request.set_session(session);
    request.mutable_options()->set_subdivision_size(0.2);
    request.mutable_options()->set_tolerance(0.05);
    return request;
}

#if defined(__SANITIZE_THREAD__)
constexpr double kLongSize = 0.02;  // everything takes ten times as long
#else
constexpr double kLongSize = 0.008;
#endif

v1::ImproveRequest long_improve(const std::string& session) {
    v1::ImproveRequest request;
    request.set_session(session);
    request.mutable_options()->set_subdivision_size(kLongSize);
    return request;
}

Downloaded download(Stub& stub, const v1::DownloadMeshRequest& request) {
    Downloaded downloaded;
    const std::unique_ptr<grpc::ClientContext> context = call();
    const auto reader = stub.DownloadMesh(context.get(), request);
    v1::MeshChunk chunk;
    while (reader->Read(&chunk)) {
        EXPECT_EQ(chunk.offset(), downloaded.file.size());
        EXPECT_LE(chunk.data().size(), std::size_t{256} * 1024);
        if (chunk.offset() == 0) downloaded.first = chunk;
        downloaded.file += chunk.data();
    }
    downloaded.status = reader->Finish();
    return downloaded;
}

Downloaded download(Stub& stub, const std::string& session, const std::string& representation, std::uint32_t faces,
                    v1::MeshFormat format) {
    v1::DownloadMeshRequest request;
    request.set_session(session);
    request.set_representation(representation);
    request.set_faces(faces);
    request.set_format(format);
    return download(stub, request);
}

RunningImprove::RunningImprove(Stub& stub, const v1::ImproveRequest& request, std::chrono::milliseconds deadline)
    : context_(call(deadline)), reader_(stub.Improve(context_.get(), request)) {}

RunningImprove::~RunningImprove() {
    if (finished_) return;
    cancel();
    static_cast<void>(finish());
}

bool RunningImprove::wait_until_queued() {
    v1::ProgressiveEvent event;
    return reader_->Read(&event) && event.has_progress();
}

bool RunningImprove::wait_until_working() {
    v1::ProgressiveEvent event;
    while (reader_->Read(&event)) {
        if (event.has_progress() && event.progress().stage() != "queued") return true;
    }
    return false;
}

grpc::Status RunningImprove::finish() {
    v1::ProgressiveEvent event;
    while (reader_->Read(&event)) continue;
    finished_ = true;
    return reader_->Finish();
}

}  // namespace vsplit::test
