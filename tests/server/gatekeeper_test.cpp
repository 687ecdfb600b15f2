#include "guard/gatekeeper.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

namespace vsplit::guard {
namespace {

using namespace std::chrono_literals;

class GatekeeperTest : public ::testing::Test {
protected:
    GatekeeperTest() { std::filesystem::create_directories(folder_); }
    ~GatekeeperTest() override { std::filesystem::remove_all(folder_); }

    void write(const std::string& text) const {
        std::ofstream(file_ + ".new") << text;
        std::filesystem::rename(file_ + ".new", file_);
    }

    std::unique_ptr<TokenBook> open() {
        auto book =
            TokenBook::open(file_, [this](const std::string& /*file*/, const Status& read) { reloads_ += read ? "+" : "-"; });
        EXPECT_TRUE(book);
        return *std::move(book);
    }

    static std::string line(const std::string& name, Access access, const std::string& token) {
        return token_line({name, access, digest_of(token)}) + '\n';
    }

    static std::string outcome(Gatekeeper& gate, const std::string& authorization, Access needed = Access::kRead) {
        const Expected<std::string> owner = gate.admit({authorization, "10.0.0.1"}, needed);
        return owner ? *owner : std::string(cause_name(owner.error().cause));
    }

    const std::string folder_ = ::testing::TempDir() + "gatekeeper_" + std::to_string(getpid());
    const std::string file_ = folder_ + "/tokens";
    std::string reloads_;
};

TEST_F(GatekeeperTest, LetsKnownTokensInAsTheirName) {
    write(line("ann", Access::kWrite, "A") + line("bob", Access::kRead, "B") + line("ann", Access::kRead, "C"));
    Gatekeeper gate(open());
    EXPECT_EQ(outcome(gate, "Bearer A", Access::kWrite), "ann");
    EXPECT_EQ(outcome(gate, "bEARER B"), "bob");
    EXPECT_EQ(outcome(gate, "Bearer B", Access::kWrite), "FORBIDDEN");
    EXPECT_EQ(outcome(gate, "Bearer C"), "ann");
    EXPECT_EQ(outcome(gate, "Bearer C", Access::kWrite), "FORBIDDEN");
    for (const char* wrong : {"", "A", "Bearer", "Bearer ", "Bearer  A", "Bearer A ", "Bearer a", "Basic A", "Bearer AB"})
        EXPECT_EQ(outcome(gate, wrong), "UNAUTHENTICATED") << wrong;
}

TEST_F(GatekeeperTest, WithoutTokensEverybodyIsOneOwner) {
    Gatekeeper gate;
    EXPECT_EQ(outcome(gate, "", Access::kWrite), "");
    EXPECT_EQ(outcome(gate, "Bearer A", Access::kWrite), "");
}

TEST_F(GatekeeperTest, ReadsAFileThatChangedAndKeepsWhatItHadOfOneThatIsBroken) {
    write(line("ann", Access::kWrite, "A"));
    Gatekeeper gate(open());
    std::this_thread::sleep_for(1050ms);
    write("no tokens at all");
    EXPECT_EQ(outcome(gate, "Bearer A"), "ann");
    EXPECT_EQ(reloads_, "-");
    std::this_thread::sleep_for(1050ms);
    write(line("bob", Access::kWrite, "B"));
    EXPECT_EQ(outcome(gate, "Bearer A"), "UNAUTHENTICATED");
    EXPECT_EQ(outcome(gate, "Bearer B"), "bob");
    EXPECT_EQ(reloads_, "-+");
}

TEST_F(GatekeeperTest, CountsRequestsByTokenAndByAddressWhereThereIsNone) {
    write(line("ann", Access::kWrite, "A") + line("bob", Access::kWrite, "B"));
    Gatekeeper gate(open(), 0.01);  // one at once
    EXPECT_EQ(outcome(gate, "Bearer A"), "ann");
    EXPECT_EQ(outcome(gate, "Bearer A"), "LIMIT_EXCEEDED");
    EXPECT_EQ(outcome(gate, "Bearer B"), "bob");
    EXPECT_EQ(outcome(gate, "Bearer guess"), "UNAUTHENTICATED");
    EXPECT_EQ(outcome(gate, "Bearer another"), "LIMIT_EXCEEDED");
    const Expected<std::string> refused = gate.admit({"Bearer A", "10.0.0.1"}, Access::kRead);
    ASSERT_FALSE(refused);
    EXPECT_GE(refused.error().retry_after, 90U);
    EXPECT_LE(refused.error().retry_after, 100U);
    EXPECT_NE(refused.error().message.find("max_request_rate"), std::string::npos);
}

TEST(RateLimiterTest, NamesAWaitForTheSmallestRatesToo) {
    for (const auto& [rate, longest] : {std::pair(0.001, 1000U), {1e-300, 1'000'000'000U}}) {
        RateLimiter limiter(rate);
        EXPECT_EQ(limiter.take("a", {}), 0U);
        EXPECT_EQ(limiter.take("a", {}), longest) << rate;
    }
}

TEST(RateLimiterTest, HoldsTheRateAfterTwoSecondsWorthAtOnce) {
    RateLimiter limiter(10);
    RateLimiter::Clock::time_point now{};
    int taken = 0;
    for (int i = 0; i < 100; ++i) taken += limiter.take("a", now) == 0 ? 1 : 0;
    EXPECT_EQ(taken, 20);
    for (int tenth = 0; tenth < 100; ++tenth) {
        now += 100ms;
        for (int i = 0; i < 3; ++i) taken += limiter.take("a", now) == 0 ? 1 : 0;
    }
    EXPECT_NEAR(taken, 120, 1);
    EXPECT_EQ(limiter.take("b", now), 0U);
    EXPECT_EQ(limiter.take("a", now), 1U);
}

TEST(RateLimiterTest, ForgetsTheQuiet) {
    RateLimiter limiter(10);
    RateLimiter::Clock::time_point now{};
    for (int i = 0; i < 100'000; ++i) {
        now += 10ms;
        ASSERT_EQ(limiter.take(std::to_string(i), now), 0U);
    }
    EXPECT_LE(limiter.clients(), 2048U);
}

}  // namespace
}  // namespace vsplit::guard
