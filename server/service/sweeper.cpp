#include "service/sweeper.h"

#include <utility>

namespace vsplit::service {

Sweeper::Sweeper(std::chrono::milliseconds interval, std::function<void()> sweep)
    : interval_(interval), sweep_(std::move(sweep)), thread_([this] { work(); }) {}

Sweeper::~Sweeper() { stop(); }

void Sweeper::stop() {
    {
        const std::lock_guard lock(mutex_);
        stopped_ = true;
    }
    stopped_changed_.notify_all();
    if (thread_.joinable()) thread_.join();
}

void Sweeper::work() {
    std::unique_lock lock(mutex_);
    while (!stopped_changed_.wait_for(lock, interval_, [this] { return stopped_; })) {
        lock.unlock();
        sweep_();
        lock.lock();
    }
}

}  // namespace vsplit::service
