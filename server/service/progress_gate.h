#pragma once

#include <chrono>
#include <string_view>

namespace vsplit::service {

/// Lets through what is worth telling: the first word of each stage, and then no more than 20 a second. Not thread-safe.
class ProgressGate {
public:
    static constexpr std::chrono::milliseconds kInterval{50};
    using Clock = std::chrono::steady_clock;

    /// \pre `stage` stays valid: a literal, as the verbs of the engine give.
    [[nodiscard]] bool open(std::string_view stage, Clock::time_point now) {
        if (stage == stage_ && now - last_ < kInterval) return false;
        stage_ = stage;
        last_ = now;
        return true;
    }

private:
    std::string_view stage_;
    Clock::time_point last_{};
};

}  // namespace vsplit::service
