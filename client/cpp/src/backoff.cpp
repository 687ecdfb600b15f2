#include "backoff.h"

#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <utility>

namespace vsplit::client {

Backoff::Backoff(const RetryOptions& options, std::stop_token stop)
    : options_(options), stop_(std::move(stop)), wait_(options.first_wait) {}

void Backoff::reset() {
    failed_ = -1;  // the try that brought something and then failed
    wait_ = options_.first_wait;
}

bool Backoff::again() {
    if (++failed_ >= options_.attempts) return false;
    std::mutex mutex;
    std::condition_variable_any over;
    std::unique_lock lock(mutex);
    over.wait_for(lock, stop_, wait_, [] { return false; });
    wait_ = std::min(2 * wait_, options_.longest_wait);
    return !stop_.stop_requested();
}

}  // namespace vsplit::client
