#include "guard/rate_limiter.h"

#include <algorithm>
#include <cmath>

namespace vsplit::guard {
namespace {

constexpr double kLongestWait = 1e9;  // seconds; of the smallest rates a number that an unsigned holds

}  // namespace

double RateLimiter::filled(const Bucket& bucket, Clock::time_point now) const {
    const double passed = std::max(0.0, std::chrono::duration<double>(now - bucket.at).count());
    return std::min(burst(), bucket.left + passed * per_second_);
}

unsigned RateLimiter::take(std::string_view client, Clock::time_point now) {
    if (per_second_ <= 0) return 0;
    const std::lock_guard lock(mutex_);
    if (buckets_.size() >= sweep_at_) forget_the_quiet(now);
    Bucket& bucket = buckets_.try_emplace(std::string(client), Bucket{burst(), now}).first->second;
    bucket = {filled(bucket, now), now};
    if (bucket.left >= 1) {
        bucket.left -= 1;
        return 0;
    }
    return static_cast<unsigned>(std::ceil(std::min((1 - bucket.left) / per_second_, kLongestWait)));
}

std::size_t RateLimiter::clients() const {
    const std::lock_guard lock(mutex_);
    return buckets_.size();
}

// Lock held. A full bucket is as good as none.
void RateLimiter::forget_the_quiet(Clock::time_point now) {
    for (auto at = buckets_.begin(); at != buckets_.end();) {
        at = filled(at->second, now) >= burst() ? buckets_.erase(at) : std::next(at);
    }
    sweep_at_ = std::max<std::size_t>(1024, 2 * buckets_.size());
}

}  // namespace vsplit::guard
