// 20 sessions from 8 clients at once, every rpc, and no word of one session in another. Run it under ThreadSanitizer.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "test_client.h"
#include "test_server.h"
#include "tests/core/meshes.h"
#include "vsplit/method/improve.h"
#include "wire/convert.h"

namespace vsplit::test {
namespace {

constexpr unsigned kSessions = 20;
constexpr unsigned kClients = 8;

// What one session must look like whatever the others do: its mesh has a size no other has.
class SessionScript {
public:
    SessionScript(unsigned number, Stub& stub)
        : stub_(stub), mesh_(torus(8 + number, 6)), bare_(torus(8 + number, 5)), random_(number) {}

    static constexpr unsigned kSteps = 8;

    void step(unsigned number) {
        switch (number) {
            case 0:
                return create();
            case 1:
                return replace_mesh();
            case 2:
                return run_improve();
            case 3:
                return move();
            case 4:
                return run_control();
            case 5:
                return cancel_one();
            case 6:
                return look();
            default:
                return remove();
        }
    }

private:
    void create() {
        id_ = session_with(stub_, bare_);
        EXPECT_EQ(get_session(stub_, id_).message.source().faces(), bare_.face_count());
    }

    void replace_mesh() {
        const Reply<v1::Session> uploaded = upload(stub_, id_, file_of(mesh_), 5000);
        ASSERT_TRUE(uploaded.status.ok()) << uploaded.status.error_message();
        EXPECT_EQ(uploaded.message.id(), id_);
        EXPECT_EQ(uploaded.message.source().faces(), mesh_.face_count());
    }

    void run_improve() {
        v1::ImproveRequest request = small_improve(id_);
        Received received = improve(stub_, request);
        ASSERT_TRUE(received.status.ok()) << received.status.error_message();
        const Expected<MethodResult> own =
            vsplit::improve(mesh_, *wire::from_proto(request.options()), {}, ExecutionContext(nullptr, 1));
        ASSERT_TRUE(own);
        EXPECT_EQ(received.representation->id(), "r1");
        EXPECT_EQ(received.representation->source().faces(), mesh_.face_count());
        EXPECT_EQ(received.representation->faces_max(), own->mrr.faces_max());
        EXPECT_EQ(received.mesh->mesh(), mesh_at(own->mrr, own->mrr.level_for(own->faces)));
        held_ = std::move(received.mesh);
        mrr_ = own->mrr;
    }

    void move() {
        for (int i = 0; i < 4; ++i) {
            const std::size_t level = random_() % (mrr_.levels() + 1);
            v1::SetResolutionRequest request;
            request.set_session(id_);
            request.set_representation("r1");
            request.set_faces_held(held_->mesh().face_count());
            request.set_faces(mrr_.faces_at(level));
            Received received = set_resolution(stub_, request, std::move(held_));
            ASSERT_TRUE(received.status.ok()) << received.status.error_message();
            held_ = std::move(received.mesh);
            if (held_->level() > level) held_->coarsen(held_->level() - level);
            EXPECT_EQ(held_->mesh(), mesh_at(mrr_, level));
            EXPECT_EQ(download(stub_, id_, "r1", mrr_.faces_at(level)).file, file_of(held_->mesh()));
        }
    }

    void run_control() {
        v1::ControlRequest request;
        request.set_session(id_);
        request.mutable_options()->set_tolerance(0.05);
        const Received received = control(stub_, request);
        ASSERT_TRUE(received.status.ok()) << received.status.error_message();
        EXPECT_EQ(received.representation->id(), "r2");
        EXPECT_EQ(received.representation->faces_max(), 4 * mesh_.face_count());
    }

    void cancel_one() {
        v1::ImproveRequest request = small_improve(id_);
        request.mutable_options()->set_subdivision_size(0.02);
        RunningImprove running(stub_, request);
        ASSERT_TRUE(running.wait_until_queued());
        running.cancel();
        static_cast<void>(running.finish());
    }

    void look() {
        const Reply<v1::Quality> quality = get_quality(stub_, id_, "r1", mrr_.faces_min());
        ASSERT_TRUE(quality.status.ok());
        EXPECT_EQ(quality.message.faces(), mrr_.faces_min());
        EXPECT_EQ(quality.message.stretch_mean(), measure_quality(mrr_.base).stretch_mean);
        const Reply<v1::Session> session = get_session(stub_, id_);
        ASSERT_TRUE(session.status.ok());
        EXPECT_EQ(session.message.source().faces(), mesh_.face_count());
        EXPECT_GE(session.message.representations_size(), 2);
        EXPECT_EQ(download(stub_, id_).file, file_of(mesh_));
    }

    void remove() {
        EXPECT_TRUE(delete_session(stub_, id_).ok());
        EXPECT_TRUE(failed_with(get_session(stub_, id_).status, Cause::kNotFound, "session"));
    }

    Stub& stub_;
    const TriangleMesh mesh_;
    const TriangleMesh bare_;
    std::minstd_rand random_;
    std::string id_;
    std::optional<ProgressiveMesh> held_;
    MultiresMesh mrr_;
};

// A client goes round its sessions, a step of each at a time.
void run_client(const TestServer& server, unsigned client) {
    const std::unique_ptr<Stub> stub = server.connect();
    std::vector<std::unique_ptr<SessionScript>> scripts;
    for (unsigned s = client; s < kSessions; s += kClients) scripts.push_back(std::make_unique<SessionScript>(s, *stub));
    for (unsigned step = 0; step < SessionScript::kSteps; ++step) {
        for (const auto& script : scripts) script->step(step);
    }
}

// Looks at whatever sessions there are while they come and go.
void look_around(const TestServer& server, const std::atomic<bool>& stop) {
    const std::unique_ptr<Stub> stub = server.connect();
    while (!stop) {
        const Reply<v1::ListSessionsResponse> list = list_sessions(*stub);
        EXPECT_TRUE(list.status.ok());
        EXPECT_LE(list.message.sessions_size(), static_cast<int>(kSessions));
        for (const v1::Session& session : list.message.sessions()) {
            const Reply<v1::Quality> quality = get_quality(*stub, session.id());
            EXPECT_TRUE(quality.status.ok() || quality.status.error_code() == grpc::StatusCode::NOT_FOUND);
        }
    }
}

TEST(ManySessionsTest, EightClientsWorkOnTwentySessionsAtOnce) {
    service::ServiceOptions options = small_server();
    options.workers = 4;
    TestServer server(options);
    std::atomic<bool> stop{false};
    std::thread observer([&] { look_around(server, stop); });
    std::vector<std::thread> clients;
    for (unsigned client = 0; client < kClients; ++client)
        clients.emplace_back([&server, client] { run_client(server, client); });
    for (std::thread& client : clients) client.join();
    stop = true;
    observer.join();
    EXPECT_EQ(list_sessions(server.stub()).message.sessions_size(), 0);
}

TEST(ManySessionsTest, ManyClientsShareOneSession) {
    TestServer server;
    const TriangleMesh mesh = torus(12, 8);
    const std::string id = session_with(server.stub(), mesh);
    std::vector<std::thread> clients;
    std::atomic<int> made{0};
    for (unsigned client = 0; client < kClients; ++client) {
        clients.emplace_back([&server, &id, &made, client] {
            const std::unique_ptr<Stub> stub = server.connect();
            v1::ImproveRequest wanted = small_improve(id);
            const unsigned pair = client / 2;  // two clients ask for the same
            wanted.mutable_options()->set_feature_weight(1 + pair);
            const Received received = improve(*stub, wanted);
            ASSERT_TRUE(received.status.ok()) << received.status.error_message();
            EXPECT_EQ(received.representation->improve_options().feature_weight(), 1 + pair);
            ++made;
            v1::SetResolutionRequest request;
            request.set_session(id);
            request.set_representation(received.representation->id());
            request.set_faces(received.representation->faces_min() + 10 * client);
            const Received level = set_resolution(*stub, request);
            ASSERT_TRUE(level.status.ok());
            EXPECT_EQ(level.representation->id(), received.representation->id());
        });
    }
    for (std::thread& client : clients) client.join();
    EXPECT_EQ(made, static_cast<int>(kClients));
    const Reply<v1::Session> session = get_session(server.stub(), id);
    ASSERT_EQ(session.message.representations_size(), static_cast<int>(kClients / 2)) << "what was made is found";
    for (int i = 0; i < session.message.representations_size(); ++i) {
        EXPECT_EQ(session.message.representations(i).id(), 'r' + std::to_string(i + 1)) << "one at a time, in order";
    }
}

}  // namespace
}  // namespace vsplit::test
