#include "rest/turns.h"

#include <utility>

namespace vsplit::rest {

void Turns::Turn::end() {
    if (!std::exchange(mine_, false)) return;
    clock_.cancel();
    turns_.leave();
}

Awaitable<std::shared_ptr<Turns::Turn>> Turns::take(const std::string& what, const net::any_io_executor& executor) {
    const auto turn = std::make_shared<Turn>(*this, executor);
    const bool at_once = enter(what, turn->called_);
    if (!at_once) co_await turn->called_->wait();
    turn->mine_ = true;
    turn->clock_.expires_after(longest_);
    turn->clock_.async_wait([weak = std::weak_ptr<Turn>(turn)](const ErrorCode& /*of a timer*/) {
        if (const std::shared_ptr<Turn> late = weak.lock()) late->end();
    });
    co_return turn;
}

bool Turns::enter(const std::string& what, const std::shared_ptr<Signal>& called) {
    const std::lock_guard lock(mutex_);
    if (taken_ < at_a_time_) {
        ++taken_;
        return true;
    }
    auto& queue = waiting_[what];
    if (queue.empty()) order_.push_back(what);
    queue.push_back(called);
    return false;
}

void Turns::leave() {
    std::shared_ptr<Signal> next;
    {
        const std::lock_guard lock(mutex_);
        if (order_.empty()) {
            --taken_;
            return;
        }
        std::string what = std::move(order_.front());
        order_.pop_front();
        const auto queue = waiting_.find(what);
        next = std::move(queue->second.front());
        queue->second.pop_front();
        if (queue->second.empty()) {
            waiting_.erase(queue);
        } else {
            order_.push_back(std::move(what));
        }
    }
    next->set();
}

}  // namespace vsplit::rest
