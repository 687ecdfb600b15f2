#include "service/job_queue.h"

#include <algorithm>
#include <string>
#include <utility>

#include "service/limits.h"

namespace vsplit::service {
namespace {

Error shutting_down() { return {Cause::kUnavailable, "the server is shutting down", ""}; }

void abandon_all(const std::deque<std::shared_ptr<Job>>& jobs, const Error& why) {
    for (const std::shared_ptr<Job>& job : jobs) job->abandon(why);
}

}  // namespace

Status JobQueue::push(std::shared_ptr<Job> job) {
    const std::lock_guard lock(mutex_);
    if (closed_) return Error{Cause::kNotFound, "the session was deleted", "session"};
    if (active_ == nullptr) {
        if (!start(job)) return shutting_down();
        return Done{};
    }
    if (waiting_.size() >= max_waiting_) {
        return Error{Cause::kLimitExceeded,
                     std::to_string(waiting_.size()) +
                         " requests wait in this session already, the server's limit max_waiting; " +
                         "try again when one is done, or use another session",
                     "session", kRetryAfter};
    }
    waiting_.push_back(std::move(job));
    return Done{};
}

void JobQueue::cancel(const std::shared_ptr<Job>& job, const Error& why) {
    std::deque<JobPointer> abandoned;
    std::deque<JobPointer> stranded;
    {
        const std::lock_guard lock(mutex_);
        if (job == active_ && !workers_.withdraw(ticket_)) {
            job->stop(why);
        } else if (job == active_) {
            abandoned.push_back(job);
            stranded = advance();
        } else {
            abandoned = take_waiting(job);
        }
    }
    abandon_all(abandoned, why);
    abandon_all(stranded, shutting_down());
}

void JobQueue::close(const Error& why) {
    std::deque<JobPointer> abandoned;
    {
        const std::lock_guard lock(mutex_);
        closed_ = true;
        abandoned.swap(waiting_);
        if (active_ != nullptr && workers_.withdraw(ticket_)) abandoned.push_front(std::exchange(active_, nullptr));
        if (active_ != nullptr) active_->stop(why);
    }
    abandon_all(abandoned, why);
}

std::size_t JobQueue::waiting() const {
    const std::lock_guard lock(mutex_);
    return waiting_.size();
}

bool JobQueue::idle() const {
    const std::lock_guard lock(mutex_);
    return active_ == nullptr;
}

// Lock held. Hands the job to the workers.
bool JobQueue::start(const JobPointer& job) {
    const std::optional<WorkerPool::Ticket> ticket = workers_.submit([self = shared_from_this(), job] { self->work(job); });
    if (!ticket) return false;
    active_ = job;
    ticket_ = *ticket;
    return true;
}

// Lock held. Lets the next job follow the active one; returns those that no worker will take any more.
std::deque<JobQueue::JobPointer> JobQueue::advance() {
    active_ = nullptr;
    if (waiting_.empty()) return {};
    if (!start(waiting_.front())) return std::exchange(waiting_, {});
    waiting_.pop_front();
    return {};
}

// Lock held.
std::deque<JobQueue::JobPointer> JobQueue::take_waiting(const JobPointer& job) {
    const auto found = std::find(waiting_.begin(), waiting_.end(), job);
    if (found == waiting_.end()) return {};
    waiting_.erase(found);
    return {job};
}

void JobQueue::work(const JobPointer& job) {
    const Job::Report report = job->run();
    std::deque<JobPointer> stranded;
    {
        const std::lock_guard lock(mutex_);
        stranded = advance();
    }
    report();
    abandon_all(stranded, shutting_down());
}

}  // namespace vsplit::service
