#pragma once

#include <atomic>
#include <csignal>
#include <stop_token>
#include <thread>

namespace vsplit::cli {

/// Turns Ctrl-C (SIGINT) and SIGTERM into a stop request; a second one ends the process at once with status 1.
///
/// The signals are blocked and a thread waits for them, so that what a stop request runs need not be safe in a signal handler.
/// Make it before any other thread: threads inherit the block. One at a time.
class InterruptWatch {
public:
    InterruptWatch();
    ~InterruptWatch();
    InterruptWatch(const InterruptWatch&) = delete;
    InterruptWatch& operator=(const InterruptWatch&) = delete;

    [[nodiscard]] std::stop_token token() const { return source_.get_token(); }

private:
    void wait();

    sigset_t signals_{};
    sigset_t blocked_before_{};
    std::stop_source source_;
    std::atomic<bool> done_{false};
    std::thread thread_;
};

}  // namespace vsplit::cli
