#include "service/job_queue.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <future>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace vsplit::service {
namespace {

using ::testing::ElementsAre;

// What happened, in order, from whatever thread.
class Journal {
public:
    void write(std::string line) {
        const std::lock_guard lock(mutex_);
        lines_.push_back(std::move(line));
    }
    std::vector<std::string> lines() const {
        const std::lock_guard lock(mutex_);
        return lines_;
    }

private:
    mutable std::mutex mutex_;
    std::vector<std::string> lines_;
};

// Runs until it is released or stopped.
class TestJob final : public Job {
public:
    TestJob(std::string name, Journal& journal) : name_(std::move(name)), journal_(journal) {}

    Report run() override {
        journal_.write(name_ + " runs");
        running_.set_value();
        const std::string how = end_.get_future().get();
        return [this, how] {
            journal_.write(name_ + ' ' + how);
            reported_.set_value();
        };
    }
    void stop(const Error& /*why*/) override { end_.set_value("stopped"); }
    void abandon(const Error& why) override { journal_.write(name_ + " abandoned: " + why.message); }

    void release() { end_.set_value("done"); }
    void wait_until_running() { running_.get_future().wait(); }
    void wait_until_reported() { reported_.get_future().wait(); }

private:
    const std::string name_;
    Journal& journal_;
    std::promise<void> running_;
    std::promise<std::string> end_;
    std::promise<void> reported_;
};

class JobQueueTest : public ::testing::Test {
protected:
    std::shared_ptr<TestJob> job(const std::string& name) { return std::make_shared<TestJob>(name, journal_); }
    std::shared_ptr<JobQueue> queue(std::size_t max_waiting = 8) { return std::make_shared<JobQueue>(workers_, max_waiting); }

    const Error why_{Cause::kCancelled, "as the test wanted", ""};
    Journal journal_;
    WorkerPool workers_{2};
};

TEST_F(JobQueueTest, RunsOneJobAtATimeInOrder) {
    const auto q = queue();
    const std::vector<std::shared_ptr<TestJob>> jobs{job("a"), job("b"), job("c")};
    for (const auto& j : jobs) ASSERT_TRUE(q->push(j));
    for (const auto& j : jobs) {
        j->wait_until_running();
        EXPECT_FALSE(q->idle());
        j->release();
        j->wait_until_reported();
    }
    EXPECT_TRUE(q->idle()) << "whoever hears of the end finds the queue free";
    workers_.shutdown();
    // A job may begin before the one before it has told of its end, but not before that end.
    const std::vector<std::string> lines = journal_.lines();
    EXPECT_EQ(lines.front(), "a runs");
    EXPECT_EQ(lines.back(), "c done");
}

TEST_F(JobQueueTest, WaitingJobsHoldUpNoOtherQueue) {
    const auto busy = queue();
    const auto other = queue();
    const auto first = job("first");
    const auto second = job("second");
    const auto third = job("third");
    ASSERT_TRUE(busy->push(first));
    ASSERT_TRUE(busy->push(second));  // would take the second worker if it waited in it
    ASSERT_TRUE(other->push(third));
    third->wait_until_running();
    for (const auto& j : {first, second, third}) j->release();
    workers_.shutdown();
}

TEST_F(JobQueueTest, RefusesMoreThanItsLimitNamingIt) {
    const auto q = queue(1);
    const auto running = job("running");
    const auto waiting = job("waiting");
    ASSERT_TRUE(q->push(running));
    ASSERT_TRUE(q->push(waiting));
    const Status refused = q->push(job("refused"));
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().cause, Cause::kLimitExceeded);
    EXPECT_THAT(refused.error().message, ::testing::HasSubstr("max_waiting"));
    running->release();
    waiting->release();
    workers_.shutdown();
}

TEST_F(JobQueueTest, CancelAbandonsWhatWaitsAtOnce) {
    const auto q = queue();
    const auto running = job("running");
    const auto waiting = job("waiting");
    ASSERT_TRUE(q->push(running));
    ASSERT_TRUE(q->push(waiting));
    running->wait_until_running();
    q->cancel(waiting, why_);
    EXPECT_THAT(journal_.lines(), ElementsAre("running runs", "waiting abandoned: as the test wanted"));
    running->release();
    workers_.shutdown();
    EXPECT_THAT(journal_.lines(), ElementsAre("running runs", "waiting abandoned: as the test wanted", "running done"));
}

TEST_F(JobQueueTest, CancelAbandonsWhatWaitsForAWorkerAndGoesOn) {
    const auto one = queue();
    const auto two = queue();
    const auto q = queue();
    const auto a = job("a");
    const auto b = job("b");
    ASSERT_TRUE(one->push(a));
    ASSERT_TRUE(two->push(b));
    a->wait_until_running();
    b->wait_until_running();  // no worker is free now
    const auto first = job("first");
    const auto second = job("second");
    ASSERT_TRUE(q->push(first));
    ASSERT_TRUE(q->push(second));
    q->cancel(first, why_);
    EXPECT_EQ(journal_.lines().back(), "first abandoned: as the test wanted");
    a->release();
    second->wait_until_running();
    second->release();
    b->release();
    workers_.shutdown();
    EXPECT_TRUE(q->idle());
}

TEST_F(JobQueueTest, CancelStopsWhatRunsAndTheNextFollows) {
    const auto q = queue();
    const auto running = job("running");
    const auto next = job("next");
    ASSERT_TRUE(q->push(running));
    ASSERT_TRUE(q->push(next));
    running->wait_until_running();
    q->cancel(running, why_);
    running->wait_until_reported();
    next->wait_until_running();
    next->release();
    next->wait_until_reported();
    q->cancel(running, why_);  // long done: nothing happens
    workers_.shutdown();
    EXPECT_TRUE(q->idle());
}

TEST_F(JobQueueTest, CloseCancelsEverythingAndRefusesMore) {
    const auto q = queue();
    const auto running = job("running");
    const auto waiting = job("waiting");
    ASSERT_TRUE(q->push(running));
    ASSERT_TRUE(q->push(waiting));
    running->wait_until_running();
    q->close(why_);
    running->wait_until_reported();
    EXPECT_THAT(journal_.lines(),
                testing::UnorderedElementsAre("running runs", "waiting abandoned: as the test wanted", "running stopped"));
    const Status refused = q->push(job("late"));
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().cause, Cause::kNotFound);
    workers_.shutdown();
}

TEST_F(JobQueueTest, RefusesWhenTheWorkersAreGone) {
    workers_.shutdown();
    const Status refused = queue()->push(job("late"));
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().cause, Cause::kUnavailable);
}

TEST_F(JobQueueTest, WhatWaitsIsToldWhenTheWorkersGo) {
    const auto q = queue();
    const auto running = job("running");
    const auto waiting = job("waiting");
    ASSERT_TRUE(q->push(running));
    ASSERT_TRUE(q->push(waiting));
    running->wait_until_running();
    auto shutdown = std::async(std::launch::async, [this] { workers_.shutdown(); });
    // Until the pool is closed it would take the next job, so the first must not end before.
    while (workers_.submit([] {})) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    running->release();
    shutdown.wait();
    EXPECT_THAT(journal_.lines(), ElementsAre("running runs", "running done", "waiting abandoned: the server is shutting down"));
}

}  // namespace
}  // namespace vsplit::service
