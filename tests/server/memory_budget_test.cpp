#include "service/memory_budget.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "service/kept.h"

namespace vsplit::service {
namespace {

using ::testing::HasSubstr;
using Text = Kept<std::string>;

/// One that can be loaded again, and counts how often it was.
struct Reloadable {
    Reloadable(const std::string& value, MemoryBudget& budget)
        : kept(Text::hold(std::make_shared<const std::string>(value), 10, budget)) {
        kept->can_be_loaded([this, value]() -> Expected<Text::Pointer> {
            ++loads;
            return std::make_shared<const std::string>(value);
        });
    }
    std::atomic<int> loads = 0;
    std::shared_ptr<Text> kept;
};

TEST(MemoryBudgetTest, GivesBackWhatAShareTook) {
    MemoryBudget budget(100);
    {
        const auto share = budget.reserve(60, "this");
        ASSERT_TRUE(share);
        EXPECT_EQ(budget.use().bytes, 60U);
        EXPECT_FALSE(budget.reserve(41, "that"));
        EXPECT_TRUE(budget.reserve(40, "that"));
    }
    EXPECT_EQ(budget.use().bytes, 0U);
}

TEST(MemoryBudgetTest, NamesTheLimitAndWhetherWaitingHelps) {
    MemoryBudget budget(100);
    const auto held = budget.reserve(60, "this");
    const auto later = budget.reserve(50, "a method on 9 faces");
    ASSERT_FALSE(later);
    EXPECT_EQ(later.error().cause, Cause::kLimitExceeded);
    EXPECT_THAT(later.error().message, HasSubstr("a method on 9 faces takes about 50 bytes"));
    EXPECT_THAT(later.error().message, HasSubstr("max_memory_bytes, 100"));
    EXPECT_GT(later.error().retry_after, 0U);
    const auto never = budget.reserve(101, "that");
    ASSERT_FALSE(never);
    EXPECT_EQ(never.error().retry_after, 0U);
}

TEST(MemoryBudgetTest, WhatIsSoonGoneMayGoAQuarterOver) {
    MemoryBudget budget(100);
    const auto held = budget.reserve(90, "this");
    const auto borrowed = budget.borrow(35, "a file");
    EXPECT_TRUE(borrowed);
    EXPECT_EQ(budget.use().bytes, 125U);
    EXPECT_FALSE(budget.borrow(1, "another"));
    EXPECT_FALSE(budget.reserve(1, "that"));
    EXPECT_TRUE(MemoryBudget(0).borrow(1'000, "a file"));
}

TEST(MemoryBudgetTest, HugeSizesDoNotWrapAround) {
    MemoryBudget budget(100);
    const auto held = budget.reserve(60, "this");
    EXPECT_FALSE(budget.reserve(~std::uint64_t{0} - 10, "that"));
    EXPECT_FALSE(budget.borrow(~std::uint64_t{0} - 10, "that"));
}

TEST(KeptTest, WhatWasUsedLeastRecentlyLeavesFirstAndComesBack) {
    MemoryBudget budget(25);
    Reloadable a("a", budget);
    Reloadable b("b", budget);
    EXPECT_EQ(**a.kept->get(), "a");  // b is now the one that was used least recently
    const auto room = budget.reserve(10, "this");
    ASSERT_TRUE(room);
    EXPECT_EQ(budget.use().evictions, 1U);
    EXPECT_EQ(**a.kept->get(), "a");
    EXPECT_EQ(a.loads, 0);
    EXPECT_EQ(**b.kept->get(), "b");
    EXPECT_EQ(b.loads, 1);
    EXPECT_LE(budget.use().bytes, 25U);
}

TEST(KeptTest, StaysWhileSomebodyHoldsIt) {
    MemoryBudget budget(15);
    Reloadable a("a", budget);
    {
        const auto held = a.kept->get();
        EXPECT_FALSE(budget.reserve(10, "this"));
    }
    EXPECT_TRUE(budget.reserve(10, "this"));
}

TEST(KeptTest, StaysWhereItCannotBeLoadedAgain) {
    MemoryBudget budget(15);
    const auto only = Text::hold(std::make_shared<const std::string>("only"), 10, budget);
    EXPECT_FALSE(budget.reserve(10, "this"));
    EXPECT_EQ(**only->get(), "only");
}

TEST(KeptTest, ComesFromElsewhereOnce) {
    MemoryBudget budget(0);
    int loads = 0;
    const auto kept = Text::elsewhere(
        [&]() -> Expected<Text::Pointer> {
            ++loads;
            return std::make_shared<const std::string>("far");
        },
        10, budget);
    EXPECT_EQ(budget.use().bytes, 0U);
    EXPECT_EQ(**kept->get(), "far");
    EXPECT_EQ(**kept->get(), "far");
    EXPECT_EQ(loads, 1);
    EXPECT_EQ(budget.use().bytes, 10U);
}

TEST(KeptTest, TellsWhyItCannotBeLoadedAndTriesAgain) {
    MemoryBudget budget(0);
    bool damaged = true;
    const auto kept = Text::elsewhere(
        [&]() -> Expected<Text::Pointer> {
            if (damaged) return Error{Cause::kCorrupt, "damaged", ""};
            return std::make_shared<const std::string>("mended");
        },
        10, budget);
    EXPECT_EQ(kept->get().error().cause, Cause::kCorrupt);
    EXPECT_EQ(budget.use().bytes, 0U);
    damaged = false;
    EXPECT_EQ(**kept->get(), "mended");
}

// Each load makes another one leave, from several threads at once.
TEST(KeptTest, ThreadsThatPushEachOtherOutGetWhatTheyAskFor) {
    MemoryBudget budget(45);
    std::vector<std::unique_ptr<Reloadable>> things;
    for (int i = 0; i < 12; ++i) things.push_back(std::make_unique<Reloadable>(std::to_string(i), budget));
    std::vector<std::thread> threads;
    for (std::size_t t = 0; t < 4; ++t) {
        threads.emplace_back([&, t] {
            for (std::size_t i = 0; i < 2000; ++i) {
                const std::size_t at = (i * 5 + t) % things.size();
                const auto value = things[at]->kept->get();
                ASSERT_TRUE(value) << value.error().message;
                EXPECT_EQ(**value, std::to_string(at));
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_LE(budget.use().bytes, 45U);
    EXPECT_GT(budget.use().evictions, 0U);
}

}  // namespace
}  // namespace vsplit::service
