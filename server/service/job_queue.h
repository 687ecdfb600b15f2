#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>

#include "service/worker_pool.h"
#include "vsplit/base/expected.h"

namespace vsplit::service {

/// Work that waits its turn in a JobQueue. Either `run` or `abandon` is called, once.
class Job {
public:
    using Report = std::function<void()>;

    Job() = default;
    virtual ~Job() = default;
    Job(const Job&) = delete;
    Job& operator=(const Job&) = delete;

    /// Does the work, on a worker. The report tells whoever waits for it; it is called when the queue has gone on, so that who
    /// hears of the end finds the queue free.
    [[nodiscard]] virtual Report run() = 0;

    /// Makes a `run` in progress, or about to begin, return soon. Any thread.
    virtual void stop(const Error& why) = 0;

    /// The job will not run. Any thread, no lock held.
    virtual void abandon(const Error& why) = 0;
};

/// The jobs of one session: one at a time, in order of arrival. Waiting jobs occupy no worker, so that a busy session does not
/// hold up another one. Thread-safe.
class JobQueue : public std::enable_shared_from_this<JobQueue> {
public:
    /// `workers` must outlive the queue's jobs.
    JobQueue(WorkerPool& workers, std::size_t max_waiting) : workers_(workers), max_waiting_(max_waiting) {}

    /// \return LIMIT_EXCEEDED when too many wait, UNAVAILABLE when the workers are shut down, NOT_FOUND after `close`.
    [[nodiscard]] Status push(std::shared_ptr<Job> job);

    /// Abandons a job that waits at once and stops one that runs. Nothing happens when it is done.
    void cancel(const std::shared_ptr<Job>& job, const Error& why);

    /// Cancels all jobs and takes no more.
    void close(const Error& why);

    /// Jobs that wait for another one of this queue.
    [[nodiscard]] std::size_t waiting() const;

    /// No job runs or waits.
    [[nodiscard]] bool idle() const;

private:
    using JobPointer = std::shared_ptr<Job>;

    [[nodiscard]] bool start(const JobPointer& job);
    [[nodiscard]] std::deque<JobPointer> advance();
    [[nodiscard]] std::deque<JobPointer> take_waiting(const JobPointer& job);
    void work(const JobPointer& job);

    WorkerPool& workers_;
    const std::size_t max_waiting_;
    mutable std::mutex mutex_;
    std::deque<JobPointer> waiting_;
    JobPointer active_;              // with the workers: waits for one, or runs
    WorkerPool::Ticket ticket_ = 0;  // of active_
    bool closed_ = false;
};

}  // namespace vsplit::service
