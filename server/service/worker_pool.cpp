#include "service/worker_pool.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace vsplit::service {

WorkerPool::WorkerPool(unsigned threads) {
    assert(threads > 0);
    threads_.reserve(threads);
    for (unsigned i = 0; i < threads; ++i) threads_.emplace_back([this] { work(); });
}

WorkerPool::~WorkerPool() { shutdown(); }

std::optional<WorkerPool::Ticket> WorkerPool::submit(Task task) {
    Ticket ticket = 0;
    {
        const std::lock_guard lock(mutex_);
        if (closed_) return std::nullopt;
        ticket = ++last_ticket_;
        waiting_.push_back({ticket, std::move(task)});
    }
    changed_.notify_one();
    return ticket;
}

bool WorkerPool::withdraw(Ticket ticket) {
    Task task;  // destroyed after the lock is released: it may own anything
    const std::lock_guard lock(mutex_);
    const auto found = std::find_if(waiting_.begin(), waiting_.end(), [ticket](const Waiting& w) { return w.ticket == ticket; });
    if (found == waiting_.end()) return false;
    task = std::move(found->task);
    waiting_.erase(found);
    return true;
}

WorkerPool::Load WorkerPool::load() const {
    const std::lock_guard lock(mutex_);
    return {running_, waiting_.size()};
}

void WorkerPool::shutdown() {
    {
        const std::lock_guard lock(mutex_);
        closed_ = true;
    }
    changed_.notify_all();
    for (std::thread& thread : threads_) {
        if (thread.joinable()) thread.join();
    }
}

std::optional<WorkerPool::Task> WorkerPool::next() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return closed_ || !waiting_.empty(); });
    if (waiting_.empty()) return std::nullopt;
    Task task = std::move(waiting_.front().task);
    waiting_.pop_front();
    ++running_;
    return task;
}

void WorkerPool::work() {
    while (std::optional<Task> task = next()) {
        (*task)();
        const std::lock_guard lock(mutex_);
        --running_;
    }
}

}  // namespace vsplit::service
