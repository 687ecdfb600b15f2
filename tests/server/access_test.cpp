// Every rpc and every route, tried without a token, with a wrong one, with a read-only one, and with another's. What there is
// comes from the descriptors, so that an rpc that is added is tried by itself.

#include <gmock/gmock.h>
#include <google/protobuf/descriptor.h>
#include <google/protobuf/dynamic_message.h>
#include <grpcpp/generic/generic_stub.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "guard/gatekeeper.h"
#include "rest/pages.h"
#include "rest/router.h"
#include "rest_client.h"
#include "test_client.h"
#include "tests/core/meshes.h"
#include "vsplit/v1/meshing.grpc.pb.h"

namespace vsplit::test {
namespace {

namespace pb = google::protobuf;
using grpc::StatusCode;

// Pages that say nothing of anybody's work: open to all.
const std::set<std::string> kOpenPages{"/", "/healthz", "/openapi.json"};

constexpr const char* kAnn = "ann-writes";
constexpr const char* kAnnReads = "ann-reads";
constexpr const char* kBob = "bob-writes";
constexpr const char* kBobReads = "bob-reads";

std::string bearer(const std::string& token) { return "Bearer " + token; }

std::unique_ptr<guard::Gatekeeper> gate_with_tokens() {
    const std::string file = ::testing::TempDir() + "access_test_" + std::to_string(getpid());
    {
        std::ofstream out(file);
        for (const char* token : {kAnn, kAnnReads, kBob, kBobReads}) {
            const std::string text = token;
            const guard::Access access = text.ends_with("writes") ? guard::Access::kWrite : guard::Access::kRead;
            out << guard::token_line({text.substr(0, 3), access, guard::digest_of(text)}) << '\n';
        }
    }
    auto book = guard::TokenBook::open(file, {});
    std::filesystem::remove(file);
    EXPECT_TRUE(book);
    return std::make_unique<guard::Gatekeeper>(*std::move(book));
}

const pb::ServiceDescriptor& contract() {
    return *pb::DescriptorPool::generated_pool()->FindServiceByName(v1::Meshing::service_full_name());
}

std::vector<const pb::MethodDescriptor*> rpcs() {
    std::vector<const pb::MethodDescriptor*> all;
    for (int i = 0; i < contract().method_count(); ++i) all.push_back(contract().method(i));
    return all;
}

bool reads(const pb::MethodDescriptor& rpc) { return rpc.options().idempotency_level() == pb::MethodOptions::NO_SIDE_EFFECTS; }

bool names_session(const pb::MethodDescriptor& rpc) { return rpc.input_type()->FindFieldByName("session") != nullptr; }

struct Answer {
    grpc::Status status;
    std::string bytes;  // of all replies
};

class AccessTest : public ::testing::Test {
protected:
    AccessTest() {
        const auto context = as(kAnn);
        v1::CreateSessionRequest request;
        request.set_mesh(file_of(icosphere(1)));
        v1::Session session;
        const grpc::Status status = doors_.grpc().stub().CreateSession(context.get(), request, &session);
        EXPECT_TRUE(status.ok()) << status.error_message();
        session_ = session.id();
    }

    static std::unique_ptr<grpc::ClientContext> as(const std::string& token) {
        auto context = call();
        if (!token.empty()) context->AddMetadata("authorization", bearer(token));
        return context;
    }

    // One message there, whatever the rpc's shape, and all replies.
    Answer ask(const pb::MethodDescriptor& rpc, const std::string& token) {
        const std::unique_ptr<pb::Message> request(factory_.GetPrototype(rpc.input_type())->New());
        if (names_session(rpc))
            request->GetReflection()->SetString(request.get(), rpc.input_type()->FindFieldByName("session"), session_);
        const std::string bytes = request->SerializeAsString();
        const grpc::Slice slice(bytes);
        const auto context = as(token);
        grpc::CompletionQueue queue;
        const auto next = [&queue] {
            void* tag = nullptr;
            bool ok = false;
            return queue.Next(&tag, &ok) && ok;
        };
        const std::string path = '/' + contract().full_name() + '/' + rpc.name();
        const auto stream = stub_.PrepareCall(context.get(), path, &queue);
        stream->StartCall(nullptr);
        if (next()) {
            stream->WriteLast(grpc::ByteBuffer(&slice, 1), {}, nullptr);
            next();
        }
        Answer answer;
        for (grpc::ByteBuffer part;;) {
            stream->Read(&part, nullptr);
            if (!next()) break;
            std::vector<grpc::Slice> slices;
            EXPECT_TRUE(part.Dump(&slices).ok());
            for (const grpc::Slice& one : slices) answer.bytes.append(reinterpret_cast<const char*>(one.begin()), one.size());
        }
        stream->Finish(&answer.status, nullptr);
        next();
        return answer;
    }

    void expect_whole() {
        const auto context = as(kAnn);
        v1::GetSessionRequest request;
        request.set_session(session_);
        v1::Session session;
        const grpc::Status status = doors_.grpc().stub().GetSession(context.get(), request, &session);
        ASSERT_TRUE(status.ok()) << status.error_message();
        EXPECT_EQ(session.representations_size(), 0);
        EXPECT_TRUE(session.has_source());
    }

    // The status of a route with this Authorization, and whether the answer knows of the session.
    HttpReply ask(const rest::Route& route, const std::string& authorization) {
        std::string path = route.path.openapi_path();
        const std::size_t variable = path.find("{session}");
        if (variable != std::string::npos) path.replace(variable, 9, session_);
        Fields fields;
        if (!authorization.empty()) fields.emplace_back("Authorization", authorization);
        const bool json = !route.body.empty() && !route.rpc->client_streaming();
        if (json) fields.emplace_back("Content-Type", "application/json");
        return vsplit::test::ask(doors_.port(), route.method, path, fields, json ? "{}" : "");
    }

    const std::unique_ptr<guard::Gatekeeper> gate_ = gate_with_tokens();
    RestFixture doors_{small_server(), {}, [this] {
                           rpc::GrpcExtras extras;
                           extras.gate = gate_.get();
                           return extras;
                       }()};
    grpc::GenericStub stub_{connected(
        grpc::CreateChannel("127.0.0.1:" + std::to_string(doors_.grpc().server().port()), grpc::InsecureChannelCredentials()))};
    pb::DynamicMessageFactory factory_;
    std::string session_;
};

TEST_F(AccessTest, NoRpcTakesACallWithoutAKnownToken) {
    ASSERT_GE(rpcs().size(), 10U);
    for (const pb::MethodDescriptor* rpc : rpcs()) {
        for (const char* token : {"", "a-guess", "(nobody)", "ann"}) {
            const Answer answer = ask(*rpc, token);
            EXPECT_EQ(answer.status.error_code(), StatusCode::UNAUTHENTICATED) << rpc->name() << " with '" << token << "'";
            EXPECT_EQ(answer.bytes, "") << rpc->name();
        }
    }
    expect_whole();
}

// What a stranger would send takes no memory then. The deadline is that of `as`: a server that waits for the message misses it.
TEST_F(AccessTest, AStrangerIsRefusedBeforeItsMessage) {
    for (const pb::MethodDescriptor* rpc : rpcs()) {
        const auto context = as("a-guess");
        grpc::CompletionQueue queue;
        const auto stream = stub_.PrepareCall(context.get(), '/' + contract().full_name() + '/' + rpc->name(), &queue);
        stream->StartCall(nullptr);
        void* tag = nullptr;
        bool ok = false;
        queue.Next(&tag, &ok);
        grpc::Status status;
        stream->Finish(&status, nullptr);
        queue.Next(&tag, &ok);
        EXPECT_EQ(status.error_code(), StatusCode::UNAUTHENTICATED) << rpc->name() << ": " << status.error_message();
    }
}

TEST_F(AccessTest, NoRpcThatWritesTakesAReadOnlyToken) {
    std::size_t writing = 0;
    for (const pb::MethodDescriptor* rpc : rpcs()) {
        for (const char* token : {kAnnReads, kBobReads}) {
            const StatusCode code = ask(*rpc, token).status.error_code();
            if (reads(*rpc)) {
                EXPECT_NE(code, StatusCode::PERMISSION_DENIED) << rpc->name();
                EXPECT_NE(code, StatusCode::UNAUTHENTICATED) << rpc->name();
            } else {
                EXPECT_EQ(code, StatusCode::PERMISSION_DENIED) << rpc->name();
                ++writing;
            }
        }
    }
    EXPECT_EQ(writing, 2U * 6U)
        << "CreateSession, UploadMesh, DeleteSession, Improve, Control, RemoveFeatures; is a new rpc marked as it should be?";
    expect_whole();
}

TEST_F(AccessTest, NoRpcShowsASessionToAnother) {
    for (const pb::MethodDescriptor* rpc : rpcs()) {
        for (const char* token : {kBob, kBobReads}) {
            const Answer answer = ask(*rpc, token);
            EXPECT_EQ(answer.bytes.find(session_), std::string::npos) << rpc->name();
            if (!names_session(*rpc) || answer.status.error_code() == StatusCode::PERMISSION_DENIED) continue;
            EXPECT_EQ(answer.status.error_code(), StatusCode::NOT_FOUND) << rpc->name() << ": " << answer.status.error_message();
            EXPECT_EQ(answer.bytes, "") << rpc->name();
        }
    }
    expect_whole();
}

TEST_F(AccessTest, AnothersSessionIsRefusedInTheWordsForOneThatIsNot) {
    const auto words = [this](const std::string& id) {
        const auto context = as(kBob);
        v1::GetSessionRequest request;
        request.set_session(id);
        v1::Session session;
        std::string message = doors_.grpc().stub().GetSession(context.get(), request, &session).error_message();
        const std::size_t at = message.find(id);
        return at == std::string::npos ? message : message.replace(at, id.size(), "ID");
    };
    EXPECT_EQ(words(session_), words(std::string(32, '0')));
}

TEST_F(AccessTest, TheOwnersReadOnlyTokenSeesTheSession) {
    const Answer answer = ask(*contract().FindMethodByName("GetSession"), kAnnReads);
    EXPECT_TRUE(answer.status.ok()) << answer.status.error_message();
    EXPECT_NE(answer.bytes.find(session_), std::string::npos);
    EXPECT_NE(ask(*contract().FindMethodByName("ListSessions"), kAnnReads).bytes.find(session_), std::string::npos);
}

TEST_F(AccessTest, NoRouteTakesWhatItsRpcDoesNot) {
    const std::vector<std::string_view> sets{rest::contract_descriptors()};
    const std::vector<std::string> services{v1::Meshing::service_full_name()};
    const auto schema = rest::Schema::make(sets, services);
    ASSERT_TRUE(schema);
    const auto router = rest::Router::make(**schema);
    ASSERT_TRUE(router);
    ASSERT_GE(router->routes().size(), 10U);
    for (const rest::Route& route : router->routes()) {
        const std::string name = route.method + ' ' + route.path.openapi_path();
        for (const std::string& token :
             {std::string(), std::string("Bearer a-guess"), std::string("Basic YTpi"), std::string(kAnn)}) {
            const HttpReply reply = ask(route, token);
            EXPECT_EQ(reply.status, 401U) << name << ' ' << reply.body;
            EXPECT_EQ(reply.fields.count("WWW-Authenticate"), 1U) << name;
        }
        const HttpReply read_only = ask(route, bearer(kBobReads));
        const HttpReply anothers = ask(route, bearer(kBob));
        const bool has_session = route.path.openapi_path().find("{session}") != std::string::npos;
        EXPECT_EQ(read_only.body.find("\"id\":\"" + session_), std::string::npos) << name;
        EXPECT_EQ(anothers.body.find("\"id\":\"" + session_), std::string::npos) << name;
        if (!reads(*route.rpc)) {
            EXPECT_EQ(read_only.status, 403U) << name << ' ' << read_only.body;
        }
        if (has_session && reads(*route.rpc)) {
            EXPECT_EQ(read_only.status, 404U) << name << ' ' << read_only.body;
        }
        if (has_session) {
            EXPECT_EQ(anothers.status, 404U) << name << ' ' << anothers.body;
        }
    }
    expect_whole();
}

TEST_F(AccessTest, NoPageButTheOpenOnesTakesARequestWithoutAToken) {
    const rest::Pages pages = rest::operations_pages({{}, [] { return std::string(); }, "{}"});
    ASSERT_GT(pages.size(), kOpenPages.size());
    for (const auto& [path, page] : pages) {
        const bool open = kOpenPages.contains(path);
        EXPECT_EQ(vsplit::test::ask(doors_.port(), "GET", path).status, open ? 200U : 401U) << path;
        EXPECT_EQ(vsplit::test::ask(doors_.port(), "GET", path, {{"Authorization", bearer("a-guess")}}).status,
                  open ? 200U : 401U)
            << path;
        EXPECT_EQ(vsplit::test::ask(doors_.port(), "GET", path, {{"Authorization", bearer(kBobReads)}}).status, 200U) << path;
    }
}

TEST_F(AccessTest, AClientCannotSpeakForAnother) {
    // The key that REST tells the client's address by is believed of calls within the process only.
    rpc::GrpcExtras extras;
    guard::Gatekeeper one_each(nullptr, 0.01);
    extras.gate = &one_each;
    TestServer server(small_server(), extras);
    std::vector<StatusCode> codes;
    for (const char* address : {"10.0.0.1", "10.0.0.2"}) {
        const auto context = call();
        context->AddMetadata("vsplit-forwarded-peer", address);
        v1::ListSessionsResponse response;
        codes.push_back(server.stub().ListSessions(context.get(), {}, &response).error_code());
    }
    EXPECT_THAT(codes, ::testing::ElementsAre(StatusCode::OK, StatusCode::RESOURCE_EXHAUSTED));
}

TEST_F(AccessTest, SessionsOfATokenAreLimited) {
    service::ServiceOptions options = small_server();
    options.limits.sessions_by_client = 2;
    rpc::GrpcExtras extras;
    extras.gate = gate_.get();
    TestServer server(options, extras);
    const auto create = [&](const char* token) {
        const auto context = as(token);
        v1::Session session;
        return server.stub().CreateSession(context.get(), {}, &session);
    };
    EXPECT_TRUE(create(kAnn).ok());
    EXPECT_TRUE(create(kAnn).ok());
    const grpc::Status refused = create(kAnn);
    EXPECT_TRUE(failed_with(refused, Cause::kLimitExceeded));
    EXPECT_THAT(refused.error_message(), ::testing::HasSubstr("max_sessions_by_client"));
    EXPECT_TRUE(create(kBob).ok());
}

TEST_F(AccessTest, RpcsAtATimeAreLimited) {
    rpc::GrpcExtras extras;
    extras.limits.rpcs = 1;
    TestServer server(small_server(), extras);
    const std::string session = session_with(server.stub(), icosphere(3));
    RunningImprove running(server.stub(), long_improve(session));
    ASSERT_TRUE(running.wait_until_working());
    const Reply<v1::Session> refused = get_session(server.stub(), session);
    EXPECT_TRUE(failed_with(refused.status, Cause::kLimitExceeded));
    EXPECT_THAT(refused.status.error_message(), ::testing::HasSubstr("max_rpcs"));
    running.cancel();
    static_cast<void>(running.finish());
    EXPECT_TRUE(eventually([&] { return get_session(server.stub(), session).status.ok(); }));
}

}  // namespace
}  // namespace vsplit::test
