#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

namespace vsplit::service {

/// A fixed number of threads that run tasks in order of arrival.
///
/// Every accepted task runs exactly once unless it is withdrawn; tasks must not throw. Thread-safe.
class WorkerPool {
public:
    using Task = std::function<void()>;
    using Ticket = std::uint64_t;

    /// \pre threads > 0.
    explicit WorkerPool(unsigned threads);
    ~WorkerPool();
    WorkerPool(const WorkerPool&) = delete;
    WorkerPool& operator=(const WorkerPool&) = delete;

    /// Empty after shutdown: the task was not taken.
    [[nodiscard]] std::optional<Ticket> submit(Task task);

    /// Takes a task back that has not begun. False when it has. O(waiting tasks).
    bool withdraw(Ticket ticket);

    /// Takes no more tasks, runs those that wait, and joins the threads. Not to be called from a task.
    void shutdown();

private:
    struct Waiting {
        Ticket ticket = 0;
        Task task;
    };

    void work();
    [[nodiscard]] std::optional<Task> next();

    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<Waiting> waiting_;
    Ticket last_ticket_ = 0;
    bool closed_ = false;
    std::vector<std::thread> threads_;
};

}  // namespace vsplit::service
