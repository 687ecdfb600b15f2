#pragma once

#include <memory>

#include "rest/asio.h"

namespace vsplit::rest {

/// What a coroutine waits for and another thread tells. All but `set` belong to the executor, a strand.
class Signal : public std::enable_shared_from_this<Signal> {
public:
    explicit Signal(const net::any_io_executor& executor) : timer_(executor, net::steady_timer::time_point::max()) {}

    [[nodiscard]] net::any_io_executor executor() { return timer_.get_executor(); }

    /// Any thread.
    void set() {
        net::post(timer_.get_executor(), [self = shared_from_this()] {
            self->set_ = true;
            self->timer_.cancel();
        });
    }

    /// Returns once it is set, also when it was before, and takes that back.
    Awaitable<void> wait() {
        const std::shared_ptr<Signal> self = shared_from_this();
        while (!set_) {
            ErrorCode woken;
            co_await timer_.async_wait(into(woken));
        }
        set_ = false;
    }

private:
    net::steady_timer timer_;
    bool set_ = false;
};

}  // namespace vsplit::rest
