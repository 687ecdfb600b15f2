// What is no longer wanted stops, soon, and harms nobody.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <future>
#include <string>
#include <thread>
#include <vector>

#include "test_client.h"
#include "test_server.h"
#include "tests/core/meshes.h"

namespace vsplit::test {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

// Generous: the machine may be busy with other things. The work itself takes longer.
#if defined(__SANITIZE_THREAD__) || defined(__SANITIZE_ADDRESS__)
constexpr seconds kSoon{40};
#else
constexpr seconds kSoon{5};
#endif

class CancellationTest : public ::testing::Test {
protected:
    std::string large_session() { return session_with(server_.stub(), icosphere(3)); }

    // No method runs or waits: only then is an upload taken.
    bool idle(const std::string& session) { return upload(server_.stub(), session, file_of(cube())).status.ok(); }

    std::size_t ended(const std::string& rpc) const {
        const std::vector<std::string> finished = server_.finished();
        return static_cast<std::size_t>(std::count(finished.begin(), finished.end(), rpc));
    }

    TestServer server_;
};

TEST_F(CancellationTest, CancellingTheCallStopsTheWork) {
    const std::string id = large_session();
    RunningImprove running(server_.stub(), long_improve(id));
    ASSERT_TRUE(running.wait_until_working());
    EXPECT_FALSE(idle(id));
    running.cancel();
    EXPECT_EQ(running.finish().error_code(), grpc::StatusCode::CANCELLED);
    EXPECT_TRUE(eventually([&] { return idle(id); }, kSoon));
    EXPECT_EQ(get_session(server_.stub(), id).message.representations_size(), 0);
    EXPECT_TRUE(eventually([&] { return ended("Improve CANCELLED") == 1; }, kSoon));
}

TEST_F(CancellationTest, CancellingBetweenTwoWordsOfProgressStopsTheWork) {
    // Whether the stream hears of it by a write that fails or by the cancel itself, the method must.
    for (int i = 0; i < 20; ++i) {
        const std::string id = large_session();
        RunningImprove running(server_.stub(), long_improve(id));
        ASSERT_TRUE(running.wait_until_queued());
        std::this_thread::sleep_for(milliseconds(3 * i));
        running.cancel();
        static_cast<void>(running.finish());
        EXPECT_TRUE(eventually([&] { return idle(id); }, kSoon));
        EXPECT_EQ(get_session(server_.stub(), id).message.representations_size(), 0);
        ASSERT_TRUE(delete_session(server_.stub(), id).ok());
    }
}

TEST_F(CancellationTest, CancellingInEveryStageStopsTheWork) {
    for (const char* stage : {"subdivide", "evaluate", "simplify"}) {
        const std::string id = large_session();
        const auto context = call();
        const auto reader = server_.stub().Improve(context.get(), long_improve(id));
        v1::ProgressiveEvent event;
        while (reader->Read(&event) && event.has_progress() && event.progress().stage() != stage) continue;
        ASSERT_EQ(event.progress().stage(), stage);
        context->TryCancel();
        while (reader->Read(&event)) continue;
        EXPECT_EQ(reader->Finish().error_code(), grpc::StatusCode::CANCELLED);
        EXPECT_TRUE(eventually([&] { return idle(id); }, kSoon)) << stage;
    }
}

TEST_F(CancellationTest, AWaitingRequestIsCancelledAtOnceAndTheRunningOneGoesOn) {
    const std::string id = large_session();
    RunningImprove running(server_.stub(), long_improve(id));
    ASSERT_TRUE(running.wait_until_working());
    RunningImprove waiting(server_.stub(), small_improve(id));
    ASSERT_TRUE(waiting.wait_until_queued());
    waiting.cancel();
    EXPECT_EQ(waiting.finish().error_code(), grpc::StatusCode::CANCELLED);
    EXPECT_TRUE(eventually([&] { return ended("Improve CANCELLED") == 1; }, kSoon)) << "while the other still runs";
    EXPECT_FALSE(idle(id));
    running.cancel();
    EXPECT_TRUE(eventually([&] { return idle(id); }, kSoon));
}

TEST_F(CancellationTest, ADeadlineStopsTheWorkRunningOrWaiting) {
    const std::string id = large_session();
    RunningImprove running(server_.stub(), long_improve(id), milliseconds(300));
    ASSERT_TRUE(running.wait_until_queued());
    RunningImprove waiting(server_.stub(), long_improve(id), milliseconds(300));
    EXPECT_EQ(running.finish().error_code(), grpc::StatusCode::DEADLINE_EXCEEDED);
    EXPECT_EQ(waiting.finish().error_code(), grpc::StatusCode::DEADLINE_EXCEEDED);
    EXPECT_TRUE(eventually([&] { return idle(id); }, kSoon));
}

TEST_F(CancellationTest, AClientThatVanishesStopsItsWork) {
    const std::string id = large_session();
    {
        const auto other = server_.connect();
        const auto context = call();
        const auto reader = other->Improve(context.get(), long_improve(id));
        v1::ProgressiveEvent event;
        ASSERT_TRUE(reader->Read(&event));
        context->TryCancel();  // a client library must; a process that dies has its connection closed by its system
    }
    EXPECT_TRUE(eventually([&] { return idle(id); }, kSoon));
}

TEST_F(CancellationTest, DeletingASessionStopsWhatRunsAndWaitsAndSaysWhy) {
    const std::string id = large_session();
    RunningImprove running(server_.stub(), long_improve(id));
    ASSERT_TRUE(running.wait_until_working());
    RunningImprove waiting(server_.stub(), long_improve(id));
    ASSERT_TRUE(waiting.wait_until_queued());
    ASSERT_TRUE(delete_session(server_.stub(), id).ok());
    for (RunningImprove* stopped : {&waiting, &running}) {
        const grpc::Status status = stopped->finish();
        EXPECT_TRUE(failed_with(status, Cause::kCancelled, "session"));
        EXPECT_EQ(status.error_message(), "the session was deleted");
    }
    // Both workers are free again.
    const std::string one = session_with(server_.stub(), icosphere(2));
    EXPECT_TRUE(improve(server_.stub(), small_improve(one)).status.ok());
}

TEST_F(CancellationTest, ACancelledStreamOfRecordsEnds) {
    const std::string id = session_with(server_.stub(), torus(60, 40));
    v1::ImproveRequest request = small_improve(id);
    request.mutable_options()->set_subdivision_size(0.05);
    ASSERT_TRUE(improve(server_.stub(), request).status.ok());
    for (int i = 0; i < 20; ++i) {
        const auto context = call();
        v1::SetResolutionRequest resolution;
        resolution.set_session(id);
        resolution.set_faces(4000000000U);
        const auto reader = server_.stub().SetResolution(context.get(), resolution);
        v1::ProgressiveEvent event;
        ASSERT_TRUE(reader->Read(&event));
        context->TryCancel();
        while (reader->Read(&event)) continue;
        static_cast<void>(reader->Finish());
    }
    EXPECT_TRUE(eventually([&] { return ended("SetResolution CANCELLED") + ended("SetResolution OK") == 20; }, kSoon));
    EXPECT_TRUE(download(server_.stub(), id, "r1").status.ok());
}

TEST_F(CancellationTest, CancellingAtAnyMomentHarmsNothing) {
    const std::string id = session_with(server_.stub(), icosphere(2));
    v1::ImproveRequest request = small_improve(id);
    for (int i = 0; i < 24; ++i) {  // fewer than the limit of representations, should every one be too late
        const auto context = call();
        const auto reader = server_.stub().Improve(context.get(), request);
        auto canceller = std::async(std::launch::async, [&context, i] {
            std::this_thread::sleep_for(std::chrono::microseconds(i * 700));
            context->TryCancel();
        });
        v1::ProgressiveEvent event;
        while (reader->Read(&event)) continue;
        static_cast<void>(reader->Finish());
        canceller.wait();
    }
    EXPECT_TRUE(eventually([&] { return idle(id); }, kSoon));
    EXPECT_LE(ended("Improve OK") + ended("Improve CANCELLED"), 24U) << "each ends once, or never came to the server";
    EXPECT_TRUE(improve(server_.stub(), request).status.ok());
}

TEST_F(CancellationTest, ShutdownEndsWhatRuns) {
    const std::string id = large_session();
    RunningImprove running(server_.stub(), long_improve(id));
    ASSERT_TRUE(running.wait_until_working());
    const auto begin = std::chrono::steady_clock::now();
    auto shutdown = std::async(std::launch::async, [this] { server_.server().shutdown(milliseconds(100)); });
    EXPECT_FALSE(running.finish().ok());
    shutdown.wait();
    server_.service().shutdown();
    EXPECT_LT(std::chrono::steady_clock::now() - begin, kSoon);
}

TEST_F(CancellationTest, WhatWaitsForAClientThatIsGoneIsNotComputed) {
    const std::string id = large_session();
    v1::GetQualityRequest quality;
    quality.set_session(id);
    v1::ListFeaturesRequest features;
    features.set_session(id);
    {
        const BlockedErrands blocked(server_.service());
        v1::Quality measured;
        EXPECT_EQ(server_.stub().GetQuality(call(milliseconds(100)).get(), quality, &measured).error_code(),
                  grpc::StatusCode::DEADLINE_EXCEEDED);
        v1::ListFeaturesResponse listed;
        EXPECT_EQ(server_.stub().ListFeatures(call(milliseconds(100)).get(), features, &listed).error_code(),
                  grpc::StatusCode::DEADLINE_EXCEEDED);
        EXPECT_EQ(ended("GetQuality CANCELLED") + ended("ListFeatures CANCELLED"), 0U);
        std::this_thread::sleep_for(milliseconds(300));  // until the server has heard of it
    }
    EXPECT_TRUE(eventually([&] { return ended("GetQuality CANCELLED") + ended("ListFeatures CANCELLED") == 2; }, kSoon));
    EXPECT_TRUE(get_quality(server_.stub(), id).status.ok());
}

}  // namespace
}  // namespace vsplit::test
