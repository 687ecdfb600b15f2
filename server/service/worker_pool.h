#pragma once

#include <condition_variable>
#include <cstddef>
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

    struct Load {
        std::size_t running = 0;  ///< tasks that a thread is at
        std::size_t waiting = 0;  ///< tasks that no thread has begun
    };
    [[nodiscard]] Load load() const;

    /// Takes no more tasks, runs those that wait, and joins the threads. Not to be called from a task.
    void shutdown();

private:
    struct Waiting {
        Ticket ticket = 0;
        Task task;
    };

    void work();
    [[nodiscard]] std::optional<Task> next();

    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<Waiting> waiting_;
    std::size_t running_ = 0;
    Ticket last_ticket_ = 0;
    bool closed_ = false;
    std::vector<std::thread> threads_;
};

}  // namespace vsplit::service
