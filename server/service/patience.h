#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <string>

namespace vsplit::service {

/// How long a client is waited for that sends something large bit by bit: what holds of both doors.
struct Patience {
    std::chrono::milliseconds stall{30'000};  ///< with one that sends nothing
    std::uint64_t slowest = 1024;             ///< bytes a second, after `stall`

    using Time = std::chrono::steady_clock::time_point;

    /// By when more must be there of what began at `start` and brought `received` bytes until `now`.
    [[nodiscard]] Time deadline(Time start, Time now, std::uint64_t received) const {
        return std::min(now + stall, start + stall + std::chrono::seconds(received / slowest));
    }

    /// As it is told to a client that was too slow.
    [[nodiscard]] std::string accepted() const {
        return "accepted are pauses of " + std::to_string(std::chrono::duration_cast<std::chrono::seconds>(stall).count()) +
               " s, and " + std::to_string(slowest) + " bytes a second";
    }
};

}  // namespace vsplit::service
