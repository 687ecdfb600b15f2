// 20 sessions from 8 threads at once without any transport: under ThreadSanitizer every race of the service shows here, since all
// that takes part is instrumented (see tests/tsan.supp for the same over gRPC).
#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <memory>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "service/meshing_service.h"
#include "service/resolution.h"
#include "tests/core/meshes.h"
#include "vsplit/io/write_mesh.h"
#include "vsplit/mrr/progressive_mesh.h"

namespace vsplit::service {
namespace {

constexpr unsigned kSessions = 20;
constexpr unsigned kThreads = 8;

std::span<const std::byte> bytes_of(const std::string& text) { return std::as_bytes(std::span(text)); }

MethodRequest small_improve() {
    ImproveOptions options;
    options.subdivision_size = 0.25;
    options.tolerance = 0.05;
    return {{}, options};
}

// A method that was begun, and its end to wait for.
class Running {
public:
    Running(MeshingService& service, const std::string& session, const MethodRequest& request) {
        JobEvents events;
        events.on_progress = [told = told_](const Progress& progress) { told->faces = progress.faces; };
        events.on_done = [told = told_](const JobOutcome& outcome) { told->done.set_value(outcome); };
        Expected<RunningMethod> started = service.start(session, request, std::move(events));
        if (started) running_ = *std::move(started);
        EXPECT_TRUE(running_.job);
    }

    void cancel() { running_.session->cancel(running_.job, {Cause::kCancelled, "no longer wanted", ""}); }
    JobOutcome wait() { return told_->done.get_future().get(); }

private:
    struct Told {
        std::atomic<std::uint32_t> faces{0};
        std::promise<JobOutcome> done;
    };
    std::shared_ptr<Told> told_ = std::make_shared<Told>();
    RunningMethod running_;
};

// One session from its creation to its end; its mesh has a size no other has.
class Script {
public:
    Script(unsigned number, MeshingService& service) : service_(service), mesh_(test::torus(8 + number, 6)) {}

    void run() {
        create();
        upload();
        for (int i = 0; i < 2; ++i) improve();
        change_resolution();
        cancel();
        EXPECT_TRUE(service_.sessions().remove(id_));
        EXPECT_FALSE(service_.snapshot(id_));
    }

private:
    void create() {
        const Expected<SessionSnapshot> created =
            service_.create_session(bytes_of(write_mesh(test::cube(), MeshFormat::kOff)), {});
        ASSERT_TRUE(created) << created.error().message;
        id_ = created->id;
    }

    void upload() {
        const std::string file = write_mesh(mesh_, MeshFormat::kPlyBinary);
        Expected<Upload> upload = service_.begin_upload(id_, {{}, file.size()});
        ASSERT_TRUE(upload) << upload.error().message;
        for (std::size_t at = 0; at < file.size(); at += 3000) ASSERT_TRUE(upload->append(at, bytes_of(file.substr(at, 3000))));
        const Expected<SessionSnapshot> session = upload->commit([] { return true; });
        ASSERT_TRUE(session) << session.error().message;
        EXPECT_EQ(**session->source->mesh->get(), mesh_);
    }

    void improve() {
        Running running(service_, id_, small_improve());
        const JobOutcome outcome = running.wait();
        ASSERT_TRUE(outcome) << outcome.error().message;
        EXPECT_EQ(outcome->representation->source().faces, mesh_.face_count());
        EXPECT_TRUE(service_.sessions().find(id_).operator*()->require_idle()) << "who hears of the end finds the session free";
    }

    void change_resolution() {
        const Expected<SessionSnapshot> session = service_.snapshot(id_);
        ASSERT_TRUE(session);
        for (const std::uint32_t faces : {1U, 100U, 300U, 100U, 1'000'000U}) {
            const auto found = find_representation(*session, "r1");
            ASSERT_TRUE(found);
            const Expected<ResolutionPlan> plan = plan_resolution(*found, {"r1", 0, faces, 0});
            ASSERT_TRUE(plan);
            EXPECT_EQ(*plan->levels->mesh(plan->level), mesh_at(plan->levels->mrr(), plan->level));
        }
    }

    void cancel() {
        MethodRequest other = small_improve();  // what was made before would be found
        std::get<ImproveOptions>(other.options).feature_weight = 3;
        Running first(service_, id_, other);
        Running second(service_, id_, other);
        second.cancel();
        first.cancel();
        for (Running* running : {&first, &second}) {
            const JobOutcome outcome = running->wait();
            EXPECT_TRUE(outcome || outcome.error().cause == Cause::kCancelled);
        }
    }

    MeshingService& service_;
    const TriangleMesh mesh_;
    std::string id_;
};

// Reads whatever there is while it comes and goes.
void look_around(MeshingService& service, const std::atomic<bool>& stop) {
    while (!stop) {
        const Expected<SessionPage> page = service.sessions().list(0, "");
        ASSERT_TRUE(page);
        for (const SessionSnapshot& session : page->sessions) {
            const Expected<PickedMesh> mesh = PickedMesh::pick(session, {});
            ASSERT_TRUE(mesh);
            const Expected<OpenedMesh> opened = mesh->open();
            ASSERT_TRUE(opened);
            EXPECT_EQ(opened->quality().faces, opened->ref.faces);
            for (const auto& representation : session.representations) {
                const auto levels = representation->levels().get();
                ASSERT_TRUE(levels);
                EXPECT_EQ((*levels)->mesh(0)->face_count(), (*levels)->mrr().faces_min());
            }
        }
    }
}

TEST(ManySessionsServiceTest, EightThreadsWorkOnTwentySessionsAtOnce) {
    ServiceOptions options;
    options.workers = 3;
    MeshingService service(options);
    std::atomic<bool> stop{false};
    std::thread reader([&] { look_around(service, stop); });
    std::atomic<unsigned> next{0};
    std::vector<std::thread> threads;
    for (unsigned t = 0; t < kThreads; ++t) {
        threads.emplace_back([&] {
            for (unsigned number = next++; number < kSessions; number = next++) Script(number, service).run();
        });
    }
    for (std::thread& thread : threads) thread.join();
    stop = true;
    reader.join();
    EXPECT_TRUE(service.sessions().list(0, "")->sessions.empty());
}

TEST(ManySessionsServiceTest, ShutdownWhileEverythingRunsTellsEveryJob) {
    ServiceOptions options;
    options.workers = 2;
    auto service = std::make_unique<MeshingService>(options);
    std::vector<std::unique_ptr<Running>> running;
    for (unsigned s = 0; s < 5; ++s) {
        const std::string file = write_mesh(test::torus(20, 10), MeshFormat::kOff);
        const std::string id = service->create_session(bytes_of(file), {})->id;
        for (int i = 0; i < 3; ++i) running.push_back(std::make_unique<Running>(*service, id, small_improve()));
    }
    service->shutdown();
    for (const auto& one : running) {
        const JobOutcome outcome = one->wait();
        EXPECT_TRUE(outcome || outcome.error().cause == Cause::kUnavailable);
    }
}

}  // namespace
}  // namespace vsplit::service
