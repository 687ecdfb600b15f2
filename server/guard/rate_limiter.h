#pragma once

#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>
#include <string_view>
#include <unordered_map>

namespace vsplit::guard {

/// A bucket for each client that fills steadily: so many requests a second in the long run, and up to two seconds' worth at
/// once. Thread-safe; a client that has been quiet for two seconds takes no memory in the long run.
class RateLimiter {
public:
    using Clock = std::chrono::steady_clock;

    /// \param per_second requests; 0: no limit
    explicit RateLimiter(double per_second) : per_second_(per_second) {}

    /// Takes one request of the client. \return 0 when it may go on, otherwise the whole seconds to wait. O(1) in the mean.
    [[nodiscard]] unsigned take(std::string_view client, Clock::time_point now);

    /// Clients that take memory.
    [[nodiscard]] std::size_t clients() const;

private:
    struct Bucket {
        double left = 0;
        Clock::time_point at;
    };

    [[nodiscard]] double burst() const { return 2 * per_second_ < 1 ? 1 : 2 * per_second_; }
    [[nodiscard]] double filled(const Bucket& bucket, Clock::time_point now) const;
    void forget_the_quiet(Clock::time_point now);

    const double per_second_;
    mutable std::mutex mutex_;
    std::unordered_map<std::string, Bucket> buckets_;
    std::size_t sweep_at_ = 1024;
};

}  // namespace vsplit::guard
