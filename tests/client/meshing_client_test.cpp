#include "vsplit/client/meshing_client.h"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <iterator>
#include <span>
#include <stop_token>
#include <thread>
#include <vector>

#include "tests/client/fake_server.h"
#include "tests/client/some_mrr.h"
#include "tests/temp_directory.h"
#include "vsplit/client/mesh_receiver.h"
#include "vsplit/mrr/record_block.h"
#include "wire/base_mesh.h"
#include "wire/convert.h"
#include "wire/error_table.h"

namespace vsplit::client {
namespace {

using std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;

class MeshingClientTest : public testing::Test {
protected:
    MeshingClient connected() {
        server_.start();
        Expected<MeshingClient> client = MeshingClient::connect(server_.target());
        EXPECT_TRUE(client);
        return *std::move(client);
    }

    test::FakeServer server_;
};

TEST(ConnectTest, SaysAtOnceThatNobodyIsThere) {
    const Clock::time_point begin = Clock::now();
    const auto client = MeshingClient::connect("127.0.0.1:1");
    ASSERT_FALSE(client);
    EXPECT_EQ(client.error().cause, Cause::kUnavailable);
    EXPECT_EQ(client.error().field, "server");
    EXPECT_NE(client.error().message.find("127.0.0.1:1"), std::string::npos);
    EXPECT_LT(Clock::now() - begin, std::chrono::seconds(3));
}

TEST(ConnectTest, RefusesWhatIsNoAddress) {
    for (const char* target : {"", "localhost", ":50051", "localhost:", "localhost:port", "localhost:70000", "unix:"}) {
        const auto client = MeshingClient::connect(target);
        ASSERT_FALSE(client) << target;
        EXPECT_EQ(client.error().cause, Cause::kInvalidOption) << target;
    }
}

TEST(ConnectTest, ObeysAStopThatWasRequested) {
    std::stop_source stop;
    stop.request_stop();
    const auto client = MeshingClient::connect("127.0.0.1:1", {milliseconds(5000), stop.get_token()});
    ASSERT_FALSE(client);
    EXPECT_EQ(client.error().cause, Cause::kCancelled);
}

TEST_F(MeshingClientTest, WhatIsSafeToAskAgainIsAskedAgainWhileTheServerIsAway) {
    int calls = 0;
    server_.on_get = [&calls](const std::string& id, v1::Session& session) {
        session.set_id(id);
        return ++calls < 3 ? grpc::Status(grpc::StatusCode::UNAVAILABLE, "restarting") : grpc::Status::OK;
    };
    MeshingClient client = connected();
    const auto session = client.get_session("s");
    ASSERT_TRUE(session) << session.error().message;
    EXPECT_EQ(session->id(), "s");
    EXPECT_EQ(calls, 3);
}

TEST_F(MeshingClientTest, RetriesEnd) {
    int calls = 0;
    server_.on_get = [&calls](const std::string&, v1::Session&) {
        ++calls;
        return grpc::Status(grpc::StatusCode::UNAVAILABLE, "away");
    };
    MeshingClient client = connected();
    CallOptions options;
    options.retry = {4, milliseconds(1), milliseconds(2)};
    const auto failed = client.get_session("s", options);
    ASSERT_FALSE(failed);
    EXPECT_EQ(failed.error().cause, Cause::kUnavailable);
    EXPECT_EQ(calls, 4);
    // At the deadline, which is that of all tries together.
    options.retry = {1000, milliseconds(20), milliseconds(20)};
    options.deadline = milliseconds(200);
    const Clock::time_point begin = Clock::now();
    EXPECT_FALSE(client.get_session("s", options));
    EXPECT_LT(Clock::now() - begin, std::chrono::seconds(5));
    // And where a stop is requested.
    std::stop_source stop;
    const std::jthread stopper([&stop] {
        std::this_thread::sleep_for(milliseconds(50));
        stop.request_stop();
    });
    CallOptions patient;
    patient.stop = stop.get_token();
    patient.retry = {1000, milliseconds(10'000), milliseconds(10'000)};
    EXPECT_FALSE(client.get_session("s", patient));
    EXPECT_LT(Clock::now() - begin, std::chrono::seconds(8));
}

TEST_F(MeshingClientTest, WhatChangesSomethingIsAskedOnce) {
    int calls = 0;
    server_.on_create = [&calls](v1::Session&) {
        ++calls;
        return grpc::Status(grpc::StatusCode::UNAVAILABLE, "away");
    };
    MeshingClient client = connected();
    EXPECT_FALSE(client.create_session());
    EXPECT_EQ(calls, 1);
}

TEST_F(MeshingClientTest, OtherErrorsAreNoReasonToAskAgain) {
    int calls = 0;
    server_.on_get = [&calls](const std::string&, v1::Session&) {
        ++calls;
        return wire::to_status({Cause::kNotFound, "none", "session"});
    };
    MeshingClient client = connected();
    EXPECT_FALSE(client.get_session("s"));
    EXPECT_EQ(calls, 1);
}

TEST_F(MeshingClientTest, RestoresErrorsOfTheServer) {
    server_.on_get = [](const std::string& id, v1::Session&) {
        return wire::to_status({Cause::kNotFound, "no session '" + id + "'", "session"});
    };
    MeshingClient client = connected();
    const auto session = client.get_session("s7");
    ASSERT_FALSE(session);
    EXPECT_EQ(session.error().cause, Cause::kNotFound);
    EXPECT_EQ(session.error().field, "session");
    EXPECT_EQ(session.error().message, "no session 's7'");
}

TEST_F(MeshingClientTest, SaysThatAServerSpeaksAnotherLanguage) {
    MeshingClient client = connected();
    const auto session = client.create_session();
    ASSERT_FALSE(session);
    EXPECT_EQ(session.error().cause, Cause::kUnsupported);
    EXPECT_NE(session.error().message.find("is it a vsplit server"), std::string::npos);
}

TEST_F(MeshingClientTest, SaysThatTheServerIsGone) {
    MeshingClient client = connected();
    server_.stop();
    const auto session = client.create_session();
    ASSERT_FALSE(session);
    EXPECT_EQ(session.error().cause, Cause::kUnavailable);
    EXPECT_NE(session.error().message.find(server_.target()), std::string::npos);
}

/// What an upload looked like to the server.
struct Uploaded {
    std::string bytes;
    v1::UploadMeshRequest first;
    std::size_t parts = 0;
    std::size_t largest = 0;
    bool in_order = true;
};

grpc::Status take_upload(grpc::ServerReader<v1::UploadMeshRequest>& reader, Uploaded& uploaded) {
    v1::UploadMeshRequest part;
    while (reader.Read(&part)) {
        if (uploaded.parts++ == 0) uploaded.first = part;
        uploaded.in_order = uploaded.in_order && part.offset() == uploaded.bytes.size();
        uploaded.largest = std::max(uploaded.largest, part.data().size());
        uploaded.bytes += part.data();
    }
    return grpc::Status::OK;
}

TEST_F(MeshingClientTest, UploadsAFileInOrderedParts) {
    const test::TempDirectory directory;
    const auto path = directory.path() / "big.bin";
    std::string content(1'000'003, '\0');
    for (std::size_t i = 0; i < content.size(); ++i) content[i] = static_cast<char>(i * 31);
    std::ofstream(path, std::ios::binary) << content;

    Uploaded uploaded;
    server_.on_upload = [&](grpc::ServerContext&, auto& reader, v1::Session& session) {
        session.set_id("s1");
        return take_upload(reader, uploaded);
    };
    MeshingClient client = connected();
    UploadOptions options;
    options.format = MeshFormat::kPlyBinary;
    options.weld = 0.5;
    std::vector<std::uint64_t> sent;
    options.on_progress = [&](std::uint64_t bytes, std::uint64_t total) {
        EXPECT_EQ(total, content.size());
        sent.push_back(bytes);
    };
    const auto session = client.upload_mesh("s1", path, options);
    ASSERT_TRUE(session);
    EXPECT_EQ(session->id(), "s1");
    EXPECT_EQ(uploaded.bytes, content);
    EXPECT_EQ(uploaded.first.session(), "s1");
    EXPECT_EQ(uploaded.first.format(), v1::PLY);
    EXPECT_EQ(uploaded.first.weld(), 0.5);
    EXPECT_EQ(uploaded.first.size(), content.size());
    EXPECT_TRUE(uploaded.in_order);
    EXPECT_LE(uploaded.largest, 256U * 1024);
    EXPECT_EQ(uploaded.parts, 4U);
    EXPECT_EQ(sent.back(), content.size());
}

TEST_F(MeshingClientTest, UploadsAnEmptyFileAsOne) {
    Uploaded uploaded;
    server_.on_upload = [&](grpc::ServerContext&, auto& reader, v1::Session&) { return take_upload(reader, uploaded); };
    MeshingClient client = connected();
    ASSERT_TRUE(client.upload_mesh("s1", std::span<const std::byte>()));
    EXPECT_EQ(uploaded.first.session(), "s1");
    EXPECT_TRUE(uploaded.first.has_size());
}

TEST_F(MeshingClientTest, HearsWhyAnUploadIsRefusedHalfway) {
    server_.on_upload = [](grpc::ServerContext&, auto& reader, v1::Session&) {
        v1::UploadMeshRequest part;
        reader.Read(&part);
        return wire::to_status({Cause::kBusy, "the session is at work", ""});
    };
    MeshingClient client = connected();
    const std::vector<std::byte> bytes(20'000'000);
    const auto session = client.upload_mesh("s1", bytes);
    ASSERT_FALSE(session);
    EXPECT_EQ(session.error().cause, Cause::kBusy);
}

TEST_F(MeshingClientTest, SaysWhichFileCannotBeUploaded) {
    server_.on_upload = [](grpc::ServerContext&, auto& reader, v1::Session&) {
        Uploaded uploaded;
        return take_upload(reader, uploaded);
    };
    MeshingClient client = connected();
    const test::TempDirectory directory;
    EXPECT_EQ(client.upload_mesh("s1", directory.path() / "none.stl").error().cause, Cause::kNotFound);
    EXPECT_EQ(client.upload_mesh("s1", directory.path()).error().cause, Cause::kFileAccess);
}

void send_mrr(const MultiresMesh& mrr, test::FakeServer::EventWriter& writer) {
    for (std::size_t part = 0; part < wire::base_mesh_parts(mrr.base); ++part) {
        v1::ProgressiveEvent event;
        *event.mutable_base_mesh() = wire::base_mesh_part(mrr.base, part);
        writer.Write(event);
    }
    v1::ProgressiveEvent block;
    *block.mutable_record_block() = wire::to_proto(encode_block(mrr.records, 0, RecordEncoding::kFloat64));
    writer.Write(block);
}

TEST_F(MeshingClientTest, BuildsTheMeshThatIsStreamed) {
    const MultiresMesh mrr = test::some_mrr(40);
    server_.on_improve = [&](grpc::ServerContext&, const v1::ImproveRequest& request, auto& writer) {
        v1::ProgressiveEvent progress;
        progress.mutable_progress()->set_stage("simplify");
        writer.Write(progress);
        send_mrr(mrr, writer);
        v1::ProgressiveEvent last;
        last.mutable_representation()->set_id(request.session() + "/r");
        writer.Write(last);
        return grpc::Status::OK;
    };
    MeshingClient client = connected();
    v1::ImproveRequest request;
    request.set_session("s1");
    MeshReceiver receiver;
    std::string stage;
    const auto made = client.improve(request, receiver.handlers([&](const v1::Progress& p) { stage = p.stage(); }));
    ASSERT_TRUE(made);
    EXPECT_EQ(made->id(), "s1/r");
    EXPECT_EQ(stage, "simplify");
    EXPECT_EQ(receiver.held(), mrr);
    EXPECT_EQ(receiver.mesh(), mesh_at(mrr, 40));
}

TEST_F(MeshingClientTest, AStreamThatBreaksOffIsAnError) {
    server_.on_improve = [](grpc::ServerContext&, const v1::ImproveRequest&, auto& writer) {
        send_mrr(test::some_mrr(3), writer);
        return grpc::Status::OK;
    };
    MeshingClient client = connected();
    const auto made = client.improve(v1::ImproveRequest());
    ASSERT_FALSE(made);
    EXPECT_EQ(made.error().cause, Cause::kCorrupt);
}

TEST_F(MeshingClientTest, AHandlersErrorEndsTheCall) {
    server_.on_improve = [](grpc::ServerContext& context, const v1::ImproveRequest&, auto& writer) {
        v1::ProgressiveEvent event;
        *event.mutable_base_mesh() = wire::base_mesh_part(TriangleMesh(), 0);
        writer.Write(event);
        for (int i = 0; i < 500 && !context.IsCancelled(); ++i) std::this_thread::sleep_for(milliseconds(10));
        return grpc::Status::CANCELLED;
    };
    MeshingClient client = connected();
    EventHandlers handlers;
    handlers.on_base_mesh = [](const StreamBase&) -> Status { return Error{Cause::kFileAccess, "the disk is full", ""}; };
    const auto made = client.improve(v1::ImproveRequest(), handlers);
    ASSERT_FALSE(made);
    EXPECT_EQ(made.error().cause, Cause::kFileAccess);
}

/// An Improve that goes on until it is cancelled, at most five seconds.
grpc::Status improve_until_cancelled(grpc::ServerContext& context, test::FakeServer::EventWriter& writer) {
    v1::ProgressiveEvent progress;
    progress.mutable_progress()->set_stage("simplify");
    writer.Write(progress);
    for (int i = 0; i < 500 && !context.IsCancelled(); ++i) std::this_thread::sleep_for(milliseconds(10));
    return grpc::Status::CANCELLED;
}

TEST_F(MeshingClientTest, IsCancelledFromAnotherThread) {
    server_.on_improve = [](grpc::ServerContext& context, const v1::ImproveRequest&, auto& writer) {
        return improve_until_cancelled(context, writer);
    };
    MeshingClient client = connected();
    std::stop_source stop;
    EventHandlers handlers;
    std::jthread stopper;
    handlers.on_progress = [&](const v1::Progress&) { stopper = std::jthread([&] { stop.request_stop(); }); };
    const Clock::time_point begin = Clock::now();
    const auto made = client.improve(v1::ImproveRequest(), handlers, {{}, stop.get_token()});
    ASSERT_FALSE(made);
    EXPECT_EQ(made.error().cause, Cause::kCancelled);
    EXPECT_LT(Clock::now() - begin, std::chrono::seconds(3));
    const auto again = client.improve(v1::ImproveRequest(), {}, {{}, stop.get_token()});
    ASSERT_FALSE(again);
    EXPECT_EQ(again.error().cause, Cause::kCancelled);
}

TEST_F(MeshingClientTest, ObeysItsDeadline) {
    server_.on_improve = [](grpc::ServerContext& context, const v1::ImproveRequest&, auto& writer) {
        return improve_until_cancelled(context, writer);
    };
    MeshingClient client = connected();
    const auto made = client.improve(v1::ImproveRequest(), {}, {milliseconds(200), {}});
    ASSERT_FALSE(made);
    EXPECT_EQ(made.error().cause, Cause::kDeadlineExceeded);
}

void send_chunk(grpc::ServerWriter<v1::MeshChunk>& writer, std::uint64_t offset, const std::string& data, std::uint64_t size) {
    v1::MeshChunk chunk;
    chunk.set_offset(offset);
    chunk.set_data(data);
    chunk.set_size(size);
    chunk.set_faces(size > 0 ? 12 : 0);
    writer.Write(chunk);
}

TEST_F(MeshingClientTest, DownloadsAFile) {
    server_.on_download = [](const v1::DownloadMeshRequest&, auto& writer) {
        send_chunk(writer, 0, "abc", 5);
        send_chunk(writer, 3, "de", 0);
        return grpc::Status::OK;
    };
    MeshingClient client = connected();
    const test::TempDirectory directory;
    const auto path = directory.path() / "out.stl";
    const auto faces = client.download_mesh(v1::DownloadMeshRequest(), path);
    ASSERT_TRUE(faces);
    EXPECT_EQ(*faces, 12U);
    std::ifstream file(path);
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(file), {}), "abcde");
}

TEST_F(MeshingClientTest, LeavesNoFileWhenADownloadFails) {
    const test::TempDirectory directory;
    const auto path = directory.path() / "out.stl";
    int order = 0;
    server_.on_download = [&](const v1::DownloadMeshRequest&, auto& writer) -> grpc::Status {
        send_chunk(writer, 0, "abc", 9);
        if (order == 1) send_chunk(writer, 5, "de", 0);
        return order == 2 ? wire::to_status({Cause::kNotFound, "gone", ""}) : grpc::Status::OK;
    };
    MeshingClient client = connected();
    const std::vector<Cause> causes{Cause::kCorrupt, Cause::kOutOfOrder, Cause::kNotFound};
    for (order = 0; order < 3; ++order) {
        const auto faces = client.download_mesh(v1::DownloadMeshRequest(), path);
        ASSERT_FALSE(faces);
        EXPECT_EQ(faces.error().cause, causes[static_cast<std::size_t>(order)]);
        EXPECT_TRUE(std::filesystem::is_empty(directory.path()));
    }
}

TEST_F(MeshingClientTest, ServesSeveralThreadsAtOnce) {
    server_.on_get = [](const std::string& id, v1::Session& session) {
        session.set_id(id);
        return grpc::Status::OK;
    };
    MeshingClient client = connected();
    constexpr int kThreads = 8;
    std::vector<std::jthread> threads;
    threads.reserve(kThreads);
    for (int t = 0; t < kThreads; ++t) {
        threads.emplace_back([&client, t] {
            for (int i = 0; i < 20; ++i) {
                const std::string id = std::to_string(t) + "-" + std::to_string(i);
                const auto session = client.get_session(id);
                EXPECT_TRUE(session && session->id() == id);
            }
        });
    }
}

}  // namespace
}  // namespace vsplit::client
