#include "service/worker_pool.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <numeric>
#include <vector>

#include "service/progress_gate.h"

namespace vsplit::service {
namespace {

// Keeps a worker from going on until it is told to.
class Gate {
public:
    void open() { opened_.set_value(); }
    WorkerPool::Task task() {
        return [this] {
            entered_.set_value();
            opened_.get_future().wait();
        };
    }
    void wait_until_entered() { entered_.get_future().wait(); }

private:
    std::promise<void> entered_;
    std::promise<void> opened_;
};

TEST(WorkerPoolTest, RunsTasksInOrderOfArrival) {
    std::vector<int> order;
    WorkerPool pool(1);
    for (int i = 0; i < 100; ++i) ASSERT_TRUE(pool.submit([&order, i] { order.push_back(i); }));
    pool.shutdown();
    std::vector<int> expected(100);
    std::iota(expected.begin(), expected.end(), 0);
    EXPECT_EQ(order, expected);
}

TEST(WorkerPoolTest, RunsAsManyTasksAtATimeAsItHasThreads) {
    WorkerPool pool(3);
    std::vector<Gate> gates(3);
    for (Gate& gate : gates) ASSERT_TRUE(pool.submit(gate.task()));
    for (Gate& gate : gates) gate.wait_until_entered();
    for (Gate& gate : gates) gate.open();
    pool.shutdown();
}

TEST(WorkerPoolTest, WithdrawsTasksThatHaveNotBegunAndNoOthers) {
    WorkerPool pool(1);
    Gate gate;
    std::atomic<int> ran{0};
    const auto running = pool.submit(gate.task());
    const auto first = pool.submit([&ran] { ran += 1; });
    const auto second = pool.submit([&ran] { ran += 10; });
    gate.wait_until_entered();
    EXPECT_FALSE(pool.withdraw(*running));
    EXPECT_TRUE(pool.withdraw(*first));
    EXPECT_FALSE(pool.withdraw(*first));
    gate.open();
    pool.shutdown();
    EXPECT_FALSE(pool.withdraw(*second));
    EXPECT_EQ(ran, 10);
}

TEST(WorkerPoolTest, ShutdownRunsWhatWaitsAndTakesNoMore) {
    WorkerPool pool(2);
    std::atomic<int> ran{0};
    for (int i = 0; i < 50; ++i) ASSERT_TRUE(pool.submit([&ran] { ++ran; }));
    pool.shutdown();
    EXPECT_EQ(ran, 50);
    EXPECT_FALSE(pool.submit([&ran] { ++ran; }));
    EXPECT_EQ(ran, 50);
}

TEST(ProgressGateTest, LetsStagesThroughAndHoldsBackTheRest) {
    using Clock = ProgressGate::Clock;
    ProgressGate gate;
    const Clock::time_point start = Clock::now();
    EXPECT_TRUE(gate.open("subdivide", start));
    EXPECT_FALSE(gate.open("subdivide", start + ProgressGate::kInterval / 2));
    EXPECT_TRUE(gate.open("simplify", start + ProgressGate::kInterval / 2));
    EXPECT_FALSE(gate.open("simplify", start + ProgressGate::kInterval));
    EXPECT_TRUE(gate.open("simplify", start + 2 * ProgressGate::kInterval));
}

TEST(ProgressGateTest, OpensAtMostTwentyTimesASecond) {
    ProgressGate gate;
    const ProgressGate::Clock::time_point start = ProgressGate::Clock::now();
    int opened = 0;
    for (int ms = 0; ms < 1000; ++ms) opened += gate.open("simplify", start + std::chrono::milliseconds(ms)) ? 1 : 0;
    EXPECT_EQ(opened, 20);
}

}  // namespace
}  // namespace vsplit::service
