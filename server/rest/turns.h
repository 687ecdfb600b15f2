#pragma once

#include <chrono>
#include <cstddef>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "rest/asio.h"
#include "rest/signal.h"

namespace vsplit::rest {

/// Lets a few begin something at a time and the others wait, so that hundreds who come at once are not before everybody else in
/// every queue behind. Those who want different things take turns: who wants what nobody else does waits for few. Thread-safe.
class Turns {
public:
    /// One's turn: until its end or its time is up.
    class Turn {
    public:
        Turn(Turns& turns, const net::any_io_executor& executor)
            : turns_(turns), clock_(executor), called_(std::make_shared<Signal>(executor)) {}
        Turn(const Turn&) = delete;
        Turn& operator=(const Turn&) = delete;
        ~Turn() { end(); }

        /// Lets the next one begin. On the executor's strand.
        void end();

    private:
        friend class Turns;

        Turns& turns_;
        net::steady_timer clock_;
        const std::shared_ptr<Signal> called_;
        bool mine_ = false;
    };

    /// \param longest of a turn: what takes longer waits for something else, and keeps nobody back
    Turns(std::size_t at_a_time, std::chrono::milliseconds longest) : at_a_time_(at_a_time), longest_(longest) {}

    /// Waits for a turn among those who want `what`. \pre `executor` is a strand, on which the turn is let go of.
    Awaitable<std::shared_ptr<Turn>> take(const std::string& what, const net::any_io_executor& executor);

private:
    [[nodiscard]] bool enter(const std::string& what, const std::shared_ptr<Signal>& called);
    void leave();

    const std::size_t at_a_time_;
    const std::chrono::milliseconds longest_;
    std::mutex mutex_;
    std::size_t taken_ = 0;
    std::map<std::string, std::deque<std::shared_ptr<Signal>>> waiting_;
    std::deque<std::string> order_;  // of those in waiting_: whose turn is next
};

}  // namespace vsplit::rest
