#include "rest/turns.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace vsplit::rest {
namespace {

using std::chrono::hours;
using std::chrono::milliseconds;

class TurnsTest : public ::testing::Test {
protected:
    // One who wants `what`, and says so when its turn begins.
    Awaitable<void> come(Turns& turns, const char* what) {
        const std::string name = what;
        const net::any_io_executor executor = context_.get_executor();
        const std::shared_ptr<Turns::Turn> turn = co_await turns.take(name, executor);
        began_.push_back(name);
        held_.push_back(turn);
    }

    void comes(Turns& turns, const char* what) {
        net::co_spawn(context_, come(turns, what), net::detached);
        run();
    }

    void run() {
        context_.restart();
        context_.poll();
    }

    // The one who began first of those who still have a turn lets it go.
    void leaves() {
        held_.erase(held_.begin());
        run();
    }

    void end_all() {
        while (!held_.empty()) leaves();
    }

    net::io_context context_;
    std::vector<std::string> began_;
    std::vector<std::shared_ptr<Turns::Turn>> held_;
};

using Names = std::vector<std::string>;

TEST_F(TurnsTest, AFewBeginAtATime) {
    Turns turns(2, hours(1));
    for (const char* what : {"a", "b", "c"}) comes(turns, what);
    EXPECT_EQ(began_, (Names{"a", "b"}));
    leaves();
    EXPECT_EQ(began_, (Names{"a", "b", "c"}));
    end_all();
    comes(turns, "d");
    comes(turns, "e");
    comes(turns, "f");
    EXPECT_EQ(began_, (Names{"a", "b", "c", "d", "e"})) << "no turn is lost";
    end_all();
}

TEST_F(TurnsTest, WhoWantsSomethingElseDoesNotWaitForAllBefore) {
    Turns turns(1, hours(1));
    for (const char* what : {"a", "a", "a", "a", "b", "c", "b"}) comes(turns, what);
    end_all();
    EXPECT_EQ(began_, (Names{"a", "a", "b", "c", "a", "b", "a"}));
}

TEST_F(TurnsTest, ATurnThatTakesLongKeepsNobodyBack) {
    Turns turns(1, milliseconds(20));
    comes(turns, "a");
    comes(turns, "b");
    EXPECT_EQ(began_, Names{"a"});
    context_.restart();
    context_.run_for(milliseconds(500));
    EXPECT_EQ(began_, (Names{"a", "b"}));
    held_.front()->end();
    comes(turns, "c");
    comes(turns, "d");
    EXPECT_EQ(began_, (Names{"a", "b", "c"})) << "a turn ends once";
    end_all();
}

}  // namespace
}  // namespace vsplit::rest
