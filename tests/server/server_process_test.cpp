// vsplitd as people run it: its one line, its exit status, health, reflection, signals, and what a stalled reader costs it.
#include "server_process.h"

#include <gmock/gmock.h>
#include <grpcpp/generic/generic_stub.h>
#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "test_client.h"
#include "tests/core/meshes.h"
#include "tests/temp_directory.h"

namespace vsplit::test {
namespace {

using std::chrono::seconds;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::StartsWith;

// Debian ships no headers for the messages of health and reflection, and these few are easily written by hand.
std::string text_field(unsigned number, const std::string& text) {
    return std::string{static_cast<char>(number << 3U | 2U), static_cast<char>(text.size())} + text;
}

grpc::ByteBuffer buffer_of(const std::string& bytes) {
    const grpc::Slice slice(bytes);
    return {&slice, 1};
}

std::string bytes_of(const grpc::ByteBuffer& buffer) {
    std::vector<grpc::Slice> slices;
    if (!buffer.Dump(&slices).ok()) return "";
    std::string bytes;
    for (const grpc::Slice& slice : slices) bytes.append(reinterpret_cast<const char*>(slice.begin()), slice.size());
    return bytes;
}

// One message there, one back, over any rpc: what streams, streams one.
Reply<std::string> exchange(const std::shared_ptr<grpc::Channel>& channel, const std::string& method,
                            const std::string& request) {
    grpc::GenericStub stub(channel);
    grpc::CompletionQueue queue;
    const auto context = call(seconds(20));
    const auto step = [&queue] {
        void* tag = nullptr;
        bool ok = false;
        return queue.Next(&tag, &ok) && ok;
    };
    Reply<std::string> reply;
    grpc::ByteBuffer response;
    const auto stream = stub.PrepareCall(context.get(), method, &queue);
    stream->StartCall(nullptr);
    EXPECT_TRUE(step());
    stream->WriteLast(buffer_of(request), {}, nullptr);
    EXPECT_TRUE(step());
    stream->Read(&response, nullptr);
    if (step()) reply.message = bytes_of(response);
    stream->Finish(&reply.status, nullptr);
    EXPECT_TRUE(step());
    return reply;
}

class ServerProcessTest : public ::testing::Test {
protected:
    void start(std::vector<std::string> arguments = {}) {
        arguments.insert(arguments.begin(), {"--listen", "127.0.0.1:0"});
        process_ = std::make_unique<ServerProcess>(arguments);
        const std::optional<std::string> line = process_->read_line();
        ASSERT_TRUE(line) << process_->errors();
        const std::string promised = "vsplitd listening on ";
        ASSERT_THAT(*line, StartsWith(promised + "127.0.0.1:"));
        const std::size_t http = line->find(" and http://127.0.0.1:");
        ASSERT_NE(http, std::string::npos) << *line;
        address_ = line->substr(promised.size(), http - promised.size());
        channel_ = connected(grpc::CreateChannel(address_, grpc::InsecureChannelCredentials()));
        stub_ = v1::Meshing::NewStub(channel_);
    }

    // NOT_FOUND, or the status that grpc.health.v1 gives: 1 is SERVING.
    std::string health(const std::string& service) {
        const Reply<std::string> reply = exchange(channel_, "/grpc.health.v1.Health/Check", text_field(1, service));
        return reply.status.ok() ? reply.message : std::to_string(reply.status.error_code());
    }

    std::unique_ptr<ServerProcess> process_;
    std::string address_;
    std::shared_ptr<grpc::Channel> channel_;
    std::unique_ptr<Stub> stub_;
};

TEST_F(ServerProcessTest, ServesAndStopsAtASignal) {
    for (const int signal : {SIGTERM, SIGINT}) {
        start();
        EXPECT_TRUE(create_session(*stub_, file_of(cube())).status.ok());
        process_->send(signal);
        EXPECT_EQ(process_->wait(), 0) << process_->errors();
    }
}

TEST_F(ServerProcessTest, PrintsOneLineAndLogsOneLineAnRpc) {
    start();
    const std::string id = session_with(*stub_, cube());
    ASSERT_FALSE(get_session(*stub_, "nobody\nelse").status.ok());
    process_->send(SIGTERM);
    EXPECT_EQ(process_->read_line(), std::nullopt) << "nothing else on stdout";
    EXPECT_EQ(process_->wait(), 0);
    EXPECT_THAT(process_->errors(), HasSubstr(" info rpc CreateSession OK "));
    EXPECT_THAT(process_->errors(), HasSubstr(" info rpc GetSession NOT_FOUND "));
    EXPECT_THAT(process_->errors(), ContainsRegex("session \"nobody\\?else\" request [0-9a-f]{32}: no session"));
}

TEST_F(ServerProcessTest, LogsNothingWhenToldTo) {
    start({"--log-level", "off"});
    ASSERT_TRUE(create_session(*stub_).status.ok());
    process_->send(SIGTERM);
    EXPECT_EQ(process_->wait(), 0);
    EXPECT_EQ(process_->errors(), "");
}

TEST_F(ServerProcessTest, TellsItsHealth) {
    start();
    const std::string serving = "\x08\x01";
    EXPECT_EQ(health(""), serving);
    EXPECT_EQ(health("vsplit.v1.Meshing"), serving);
    EXPECT_EQ(health("vsplit.v1.Unknown"), std::to_string(grpc::StatusCode::NOT_FOUND));
}

TEST_F(ServerProcessTest, DescribesItselfByReflection) {
    start();
    const std::string method = "/grpc.reflection.v1alpha.ServerReflection/ServerReflectionInfo";
    const Reply<std::string> services = exchange(channel_, method, text_field(7, ""));
    ASSERT_TRUE(services.status.ok()) << services.status.error_message();
    EXPECT_THAT(services.message, HasSubstr("vsplit.v1.Meshing"));
    EXPECT_THAT(services.message, HasSubstr("grpc.health.v1.Health"));
    const Reply<std::string> file = exchange(channel_, method, text_field(4, "vsplit.v1.Meshing"));
    EXPECT_THAT(file.message, HasSubstr("vsplit/v1/meshing.proto"));
    EXPECT_THAT(file.message, HasSubstr("SetResolution"));
}

TEST_F(ServerProcessTest, RefusesAPortThatIsTakenAndSaysSo) {
    start();
    ServerProcess second({"--listen", address_});
    EXPECT_EQ(second.read_line(), std::nullopt);
    EXPECT_EQ(second.wait(), 1);
    EXPECT_EQ(second.errors(), "vsplitd: cannot listen on " + address_ + ": Address already in use\n");
    EXPECT_TRUE(create_session(*stub_).status.ok()) << "the first one serves on";
}

TEST_F(ServerProcessTest, RefusesBadArguments) {
    const std::vector<std::vector<std::string>> cases{
        {"--listen", "nowhere"},
        {"--listen", "127.0.0.1"},
        {"--listen", "127.0.0.1:99999"},
        {"--listen", "::1:80"},
        {"--listen", ":80"},
        {"--session-ttl", "0"},
        {"--session-ttl", "never"},
        {"--max-sessions", "-1"},
        {"--workers", "100000"},
        {"--max-faces", "99999999999"},
        {"--log-level", "loud"},
        {"--http", "nowhere"},
        {"--listen", "127.0.0.1:0", "--http", "127.0.0.1:99999"},
        {"an argument without a purpose"},
    };
    for (const std::vector<std::string>& arguments : cases) {
        ServerProcess process(arguments);
        EXPECT_EQ(process.wait(), 1) << arguments.back();
        EXPECT_GT(process.errors().size(), 10U) << arguments.back();
    }
}

TEST_F(ServerProcessTest, HelpAndVersionAreNoErrors) {
    for (const char* flag : {"--help", "--version"}) {
        ServerProcess process({flag});
        const std::optional<std::string> line = process.read_line();
        ASSERT_TRUE(line);
        EXPECT_THAT(*line, StartsWith("vsplitd"));
        EXPECT_EQ(process.wait(), 0);
    }
}

TEST_F(ServerProcessTest, LimitsAreFlags) {
    start({"--max-upload-bytes", "3000", "--max-sessions", "2", "--max-faces", "100", "--session-ttl", "77"});
    const Reply<v1::Session> created = create_session(*stub_, file_of(icosphere(1)));
    ASSERT_TRUE(created.status.ok());
    EXPECT_NEAR(static_cast<double>(created.message.expire_time().seconds() - created.message.create_time().seconds()), 77, 2);
    EXPECT_TRUE(failed_with(upload(*stub_, created.message.id(), file_of(icosphere(2))).status, Cause::kLimitExceeded, "size"));
    EXPECT_FALSE(create_session(*stub_, file_of(icosphere(2))).status.ok()) << "320 faces";
    EXPECT_TRUE(create_session(*stub_).status.ok());
    EXPECT_TRUE(failed_with(create_session(*stub_).status, Cause::kLimitExceeded));
}

TEST_F(ServerProcessTest, StopsSoonWhenNothingRuns) {
    start();
    ASSERT_TRUE(create_session(*stub_).status.ok());  // the connection stays
    process_->send(SIGTERM);
    EXPECT_EQ(process_->wait(seconds(4)), 0) << "less than the grace for what runs";
}

/// One that outlasts every grace.
v1::ImproveRequest endless_improve(const std::string& session) {
    v1::ImproveRequest request = long_improve(session);
    request.mutable_options()->set_subdivision_size(0.006);
    return request;
}

TEST_F(ServerProcessTest, AMethodThatRunsDelaysTheEndByTheGraceAtMost) {
    start({"--workers", "1"});
    const std::string id = session_with(*stub_, icosphere(3));
    RunningImprove running(*stub_, endless_improve(id));
    ASSERT_TRUE(running.wait_until_working());
    process_->send(SIGTERM);
    EXPECT_EQ(process_->wait(seconds(60)), 0);
    EXPECT_FALSE(running.finish().ok());
}

TEST_F(ServerProcessTest, AMethodThatTheEndCutsOffIsKnownAfterTheNextStart) {
    const TempDirectory scratch;
    const std::vector<std::string> arguments{"--workers", "1", "--drain", "1", "--data-dir", scratch.path().string()};
    start(arguments);
    const std::string id = session_with(*stub_, icosphere(3));
    {
        RunningImprove running(*stub_, endless_improve(id));
        ASSERT_TRUE(running.wait_until_working());
        process_->send(SIGTERM);
        EXPECT_EQ(process_->wait(seconds(60)), 0);
        const grpc::Status status = running.finish();
        EXPECT_EQ(status.error_code(), grpc::StatusCode::UNAVAILABLE);
        EXPECT_THAT(status.error_message(), HasSubstr("shutting down"));
    }
    start(arguments);
    const auto context = call();
    v1::GetSessionRequest get;
    get.set_session(id);
    v1::Session session;
    ASSERT_TRUE(stub_->GetSession(context.get(), get, &session).ok());
    EXPECT_EQ(session.interrupted_size(), 1);
}

TEST_F(ServerProcessTest, KeepAliveOutlivesAKill) {
    const TempDirectory scratch;
    const std::vector<std::string> arguments{"--session-ttl", "8", "--data-dir", scratch.path().string()};
    start(arguments);
    const std::string id = create_session(*stub_).message.id();
    std::this_thread::sleep_for(std::chrono::milliseconds(3500));  // a sweep, each 2 s, has told the disk what time it is
    v1::KeepAliveRequest request;
    request.set_session(id);
    v1::Session told;
    ASSERT_TRUE(stub_->KeepAlive(call().get(), request, &told).ok());
    process_.reset();  // by SIGKILL
    start(arguments);
    v1::ListSessionsResponse all;
    ASSERT_TRUE(stub_->ListSessions(call().get(), {}, &all).ok());
    ASSERT_EQ(all.sessions_size(), 1);
    const auto left =
        all.sessions(0).expire_time().seconds() - std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
    EXPECT_GE(left, 7) << "of 8 s, when KeepAlive was just answered";
}

// A sanitizer keeps books about memory that take more than the memory itself.
#if !defined(__SANITIZE_THREAD__) && !defined(__SANITIZE_ADDRESS__)
TEST_F(ServerProcessTest, AStalledReaderCostsLittleMemory) {
    start();
    const TriangleMesh mesh = torus(600, 500);  // 600,000 faces: 30 MB as text
    const std::string id = create_session(*stub_).message.id();
    ASSERT_TRUE(upload(*stub_, id, file_of(mesh), std::size_t{256} * 1024).status.ok());
    v1::DownloadMeshRequest request;
    request.set_session(id);
    request.set_format(v1::PLY_ASCII);
    constexpr std::size_t kReaders = 6;
    const auto wait_until_settled = [this] {
        std::size_t before = 0;
        static_cast<void>(eventually([&] { return std::exchange(before, process_->memory()) == process_->memory(); }));
        return process_->memory();
    };
    const auto read_first = [&](grpc::ClientReader<v1::MeshChunk>& reader) {
        v1::MeshChunk chunk;
        ASSERT_TRUE(reader.Read(&chunk));
        ASSERT_GT(chunk.size(), std::uint64_t{20} << 20);
    };
    ASSERT_TRUE(download(*stub_, request).status.ok());  // what the allocator keeps of the first is not a reader's cost
    const std::size_t before = wait_until_settled();
    std::vector<std::unique_ptr<grpc::ClientContext>> contexts;
    std::vector<std::unique_ptr<grpc::ClientReader<v1::MeshChunk>>> readers;
    for (std::size_t i = 0; i < kReaders; ++i) {
        contexts.push_back(call());
        readers.push_back(stub_->DownloadMesh(contexts.back().get(), request));
        read_first(*readers.back());
    }
    const std::size_t after = std::max(wait_until_settled(), before);
    RecordProperty("bytes_a_reader", std::to_string((after - before) / kReaders));
    EXPECT_LT(after - before, kReaders * (std::size_t{8} << 20)) << (after - before) / kReaders << " bytes a reader";
    EXPECT_TRUE(get_session(*stub_, id).status.ok()) << "others are served";
    for (const auto& context : contexts) context->TryCancel();
    for (const auto& reader : readers) static_cast<void>(reader->Finish());
}
#endif

}  // namespace
}  // namespace vsplit::test
