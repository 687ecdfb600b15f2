#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace vsplit::service {

/// A thread that calls a function again and again.
class Sweeper {
public:
    Sweeper(std::chrono::milliseconds interval, std::function<void()> sweep);
    ~Sweeper();
    Sweeper(const Sweeper&) = delete;
    Sweeper& operator=(const Sweeper&) = delete;

    /// Returns when no sweep is under way and none will follow.
    void stop();

private:
    void work();

    const std::chrono::milliseconds interval_;
    const std::function<void()> sweep_;
    std::mutex mutex_;
    std::condition_variable stopped_changed_;
    bool stopped_ = false;
    std::thread thread_;
};

}  // namespace vsplit::service
