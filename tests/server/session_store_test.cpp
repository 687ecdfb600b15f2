#include "service/session_store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <future>
#include <memory>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "service/random_id.h"
#include "service/sweeper.h"
#include "tests/core/meshes.h"

namespace vsplit::service {
namespace {

using std::chrono::milliseconds;
using ::testing::HasSubstr;

std::shared_ptr<const SourceMesh> source_of(const TriangleMesh& mesh) {
    static MemoryBudget budget(0);
    return make_source(mesh, inspect(mesh), budget);
}

/// What a store needs beside its options.
struct Host {
    explicit Host(ServiceOptions given) : options(std::move(given)) {}
    ServiceOptions options;
    MemoryBudget memory{0};
    SessionArchive archive;
    WorkerPool workers{1};
    SessionHost shared{options, memory, archive, workers};
};

ServiceOptions options_with(std::uint32_t sessions, milliseconds ttl) {
    ServiceOptions options;
    options.limits.sessions = sessions;
    options.session_ttl = ttl;
    return options;
}

// Waits in its queue's worker until it is stopped.
class WaitingJob final : public Job {
public:
    Report run() override {
        stopped_.get_future().wait();
        return [] {};
    }
    void stop(const Error& why) override {
        why_ = why.message;
        stopped_.set_value();
    }
    void abandon(const Error& why) override { why_ = why.message; }
    const std::string& why() const { return why_; }

private:
    std::promise<void> stopped_;
    std::string why_;
};

class SessionStoreTest : public ::testing::Test {
protected:
    Host host_{options_with(3, std::chrono::hours(1))};
    SessionStore store_{host_.shared};
    Host hasty_{options_with(3, milliseconds(40))};
    SessionStore short_lived_{hasty_.shared};
};

TEST(RandomIdTest, Has128BitsAndDoesNotRepeat) {
    std::set<std::string> ids;
    for (int i = 0; i < 1000; ++i) {
        const Expected<std::string> id = random_id();
        ASSERT_TRUE(id);
        EXPECT_EQ(id->size(), 32U);
        EXPECT_EQ(id->find_first_not_of("0123456789abcdef"), std::string::npos);
        ids.insert(*id);
    }
    EXPECT_EQ(ids.size(), 1000U);
}

TEST_F(SessionStoreTest, FindsWhatItCreated) {
    const auto created = store_.create(source_of(test::cube()));
    ASSERT_TRUE(created);
    const auto found = store_.find((*created)->id());
    ASSERT_TRUE(found);
    EXPECT_EQ(*found, *created);
    EXPECT_EQ((*found)->snapshot().source->report.faces, 12U);
}

TEST_F(SessionStoreTest, SaysWhichSessionItDoesNotKnow) {
    const auto found = store_.find("nobody\n\"" + std::string(1000, 'x'));
    ASSERT_FALSE(found);
    EXPECT_EQ(found.error().cause, Cause::kNotFound);
    EXPECT_EQ(found.error().field, "session");
    EXPECT_THAT(found.error().message, HasSubstr("\"nobody??xxx"));
    EXPECT_LT(found.error().message.size(), 200U);
    EXPECT_FALSE(store_.remove("nobody"));
}

TEST_F(SessionStoreTest, HoldsNoMoreThanItsLimit) {
    for (int i = 0; i < 3; ++i) ASSERT_TRUE(store_.create(nullptr));
    const auto refused = store_.create(nullptr);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().cause, Cause::kLimitExceeded);
    EXPECT_THAT(refused.error().message, HasSubstr("max_sessions"));
    EXPECT_FALSE(store_.require_room());
    ASSERT_TRUE(store_.remove(store_.list(1, "")->sessions.front().id));
    EXPECT_TRUE(store_.create(nullptr));
}

TEST_F(SessionStoreTest, ExpiredSessionsMakeRoomAndAreNotFound) {
    for (int i = 0; i < 3; ++i) ASSERT_TRUE(short_lived_.create(nullptr));
    const std::string id = short_lived_.list(1, "")->sessions.front().id;
    std::this_thread::sleep_for(milliseconds(60));
    EXPECT_FALSE(short_lived_.find(id)) << "expired, swept or not";
    EXPECT_TRUE(short_lived_.list(0, "")->sessions.empty());
    EXPECT_TRUE(short_lived_.require_room());
}

TEST_F(SessionStoreTest, EveryUseMovesTheExpiry) {
    const std::string id = (*short_lived_.create(nullptr))->id();
    const std::string unused = (*short_lived_.create(nullptr))->id();
    const auto before = (*short_lived_.find(id))->snapshot().expire_time;
    for (int i = 0; i < 12; ++i) {
        std::this_thread::sleep_for(milliseconds(5));
        ASSERT_TRUE(short_lived_.find(id)) << "round " << i;
        short_lived_.remove_expired();
    }
    EXPECT_GT((*short_lived_.find(id))->snapshot().expire_time, before);
    EXPECT_FALSE(short_lived_.find(unused));
}

TEST_F(SessionStoreTest, ASessionAtWorkDoesNotExpire) {
    const auto session = *short_lived_.create(nullptr);
    const auto job = std::make_shared<WaitingJob>();
    const auto queued =
        session->enqueue({}, [&](const SessionSnapshot&) -> Expected<std::shared_ptr<Job>> { return std::shared_ptr<Job>(job); });
    ASSERT_TRUE(queued);
    std::this_thread::sleep_for(milliseconds(60));
    EXPECT_EQ(short_lived_.remove_expired(), 0U);
    EXPECT_TRUE(short_lived_.find(session->id()));
    session->cancel(job, {Cause::kCancelled, "enough", ""});
    hasty_.workers.shutdown();
    std::this_thread::sleep_for(milliseconds(60));
    EXPECT_EQ(short_lived_.remove_expired(), 1U);
}

TEST_F(SessionStoreTest, RemovingASessionStopsItsJobs) {
    const auto session = *store_.create(nullptr);
    const auto job = std::make_shared<WaitingJob>();
    const auto make = [&](const SessionSnapshot&) -> Expected<std::shared_ptr<Job>> { return std::shared_ptr<Job>(job); };
    ASSERT_TRUE(session->enqueue({}, make));
    ASSERT_TRUE(store_.remove(session->id()));
    host_.workers.shutdown();  // returns: the job has ended
    EXPECT_EQ(job->why(), "the session was deleted");
    const auto late = session->enqueue({}, make);
    ASSERT_FALSE(late);
    EXPECT_EQ(late.error().cause, Cause::kNotFound);
    EXPECT_EQ(session->set_source(source_of(test::cube())).error().cause, Cause::kNotFound);
}

TEST_F(SessionStoreTest, ListsInOrderOfCreationInPages) {
    std::vector<std::string> created;
    for (int i = 0; i < 3; ++i) created.push_back((*store_.create(nullptr))->id());
    std::vector<std::string> listed;
    std::string token;
    do {
        const Expected<SessionPage> page = store_.list(1, token);
        ASSERT_TRUE(page);
        ASSERT_EQ(page->sessions.size(), 1U);
        listed.push_back(page->sessions.front().id);
        token = page->next_page_token;
    } while (!token.empty());
    EXPECT_EQ(listed, created);
    EXPECT_EQ(store_.list(0, "")->sessions.size(), 3U);
}

TEST_F(SessionStoreTest, APageGoesOnWhereALaterDeletedSessionWas) {
    std::vector<std::string> created;
    for (int i = 0; i < 3; ++i) created.push_back((*store_.create(nullptr))->id());
    const std::string token = store_.list(1, "")->next_page_token;
    ASSERT_TRUE(store_.remove(created[0]));
    ASSERT_TRUE(store_.remove(created[1]));
    const Expected<SessionPage> rest = store_.list(10, token);
    ASSERT_TRUE(rest);
    ASSERT_EQ(rest->sessions.size(), 1U);
    EXPECT_EQ(rest->sessions.front().id, created[2]);
}

TEST_F(SessionStoreTest, RefusesAForeignPageToken) {
    for (const char* token : {"abc", "1x", "-1", "99999999999999999999"}) {
        const Expected<SessionPage> page = store_.list(1, token);
        ASSERT_FALSE(page) << token;
        EXPECT_EQ(page.error().cause, Cause::kInvalidOption);
        EXPECT_EQ(page.error().field, "page_token");
    }
}

TEST_F(SessionStoreTest, ReadersKeepWhatTheyHold) {
    const auto session = *store_.create(source_of(test::cube()));
    const SessionSnapshot before = session->snapshot();
    ASSERT_TRUE(session->set_source(source_of(test::tetrahedron())));
    ASSERT_TRUE(store_.remove(session->id()));
    EXPECT_EQ(before.source->report.faces, 12U);
    EXPECT_EQ(session->snapshot().source->report.faces, 4U);
}

TEST_F(SessionStoreTest, AnUploadDropsRepresentationsAndNeverReusesAnId) {
    const auto session = *store_.create(source_of(test::tetrahedron()));
    MethodResult result;
    result.mrr.base = test::tetrahedron();
    result.faces = 4;
    EXPECT_EQ((*session->add_representation({}, result))->id(), "r1");
    EXPECT_EQ((*session->add_representation({}, result))->id(), "r2");
    EXPECT_EQ((*newest_representation(session->snapshot()))->id(), "r2");
    ASSERT_TRUE(session->set_source(source_of(test::cube())));
    EXPECT_EQ(newest_representation(session->snapshot()).error().cause, Cause::kNotReady);
    EXPECT_EQ((*session->add_representation({}, result))->id(), "r3");
    const auto unknown = find_representation(session->snapshot(), "r1");
    ASSERT_FALSE(unknown);
    EXPECT_EQ(unknown.error().field, "representation");
    EXPECT_THAT(unknown.error().message, HasSubstr("it has r3"));
}

TEST_F(SessionStoreTest, RefusesMoreRepresentationsThanItsLimit) {
    ServiceOptions options;
    options.limits.representations = 1;
    Host host(options);
    Session session({.number = 1, .id = "id", .expires = std::chrono::hours(1), .source = source_of(test::tetrahedron())},
                    Session::Clock::now(), host.shared);
    MethodResult result;
    result.mrr.base = test::tetrahedron();
    ASSERT_TRUE(session.add_representation({}, result));
    const auto refused = session.enqueue(ControlOptions(), [](const SessionSnapshot&) -> Expected<std::shared_ptr<Job>> {
        ADD_FAILURE() << "no job is made when there is no room for what it makes";
        return std::shared_ptr<Job>(std::make_shared<WaitingJob>());
    });
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().cause, Cause::kLimitExceeded);
    EXPECT_THAT(refused.error().message, HasSubstr("max_representations"));
}

TEST_F(SessionStoreTest, KnowsWhatItHasMadeBefore) {
    const auto session = *store_.create(source_of(test::tetrahedron()));
    MethodResult result;
    result.mrr.base = test::tetrahedron();
    const MethodRequest request{{"", 4}, ImproveOptions{.tolerance = 0.5}};
    const auto made = session->add_representation(request, result);
    ASSERT_TRUE(made);
    EXPECT_EQ(session->find_made(request), *made);
    EXPECT_EQ(session->find_made({{"", 4}, ImproveOptions{.tolerance = 0.25}}), nullptr);
    EXPECT_EQ(session->find_made({{"r1", 4}, request.options}), nullptr);
    EXPECT_EQ(session->find_made({{"", 4}, ControlOptions{.tolerance = 0.5}}), nullptr);
    ASSERT_TRUE(session->set_source(source_of(test::cube())));
    EXPECT_EQ(session->find_made(request), nullptr) << "that was of another mesh";
}

TEST(SweeperTest, SweepsUntilStopped) {
    std::promise<void> third;
    int sweeps = 0;
    Sweeper sweeper(milliseconds(2), [&] {
        if (++sweeps == 3) third.set_value();
    });
    third.get_future().wait();
    sweeper.stop();
    const int at_stop = sweeps;
    std::this_thread::sleep_for(milliseconds(10));
    EXPECT_EQ(sweeps, at_stop);
}

}  // namespace
}  // namespace vsplit::service
