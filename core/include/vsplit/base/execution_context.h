#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <string_view>
#include <utility>

#include "vsplit/base/expected.h"

namespace vsplit {

/// How far a verb has come. `fraction` never decreases within a stage; the stages of a verb are named where it is declared.
struct Progress {
    std::string_view stage;   ///< e.g. "subdivide", "evaluate", "simplify"
    double fraction = 0;      ///< 0..1 of this stage
    std::uint32_t faces = 0;  ///< faces of the mesh at this moment
};

/// What a long verb runs in: who hears of its progress, who may stop it, how many threads it may take.
///
/// Progress is reported at every stage and every 1024 collapses, or after each round of those made in parts of a large mesh,
/// always on the thread that called the verb. A cancel is obeyed every 64 collapses and between passes over all faces: well under
/// 10 ms while simplifying, as long as a pass takes elsewhere. Not copyable; must outlive the call. `cancel()` may be called from
/// any thread.
class ExecutionContext {
public:
    using ProgressHandler = std::function<void(const Progress&)>;
    using Clock = std::chrono::steady_clock;

    ExecutionContext() = default;
    explicit ExecutionContext(ProgressHandler on_progress, unsigned threads = 0)
        : on_progress_(std::move(on_progress)), threads_(threads) {}
    ExecutionContext(const ExecutionContext&) = delete;
    ExecutionContext& operator=(const ExecutionContext&) = delete;

    void cancel() { cancelled_.store(true, std::memory_order_relaxed); }
    /// Cancels when `time` comes. \pre nothing runs in this yet.
    void cancel_at(Clock::time_point time) { until_ = time; }
    /// Cancels when `unwanted` is true; it is asked from any thread of the verb, and often. \pre nothing runs in this yet.
    void cancel_when(std::function<bool()> unwanted) { unwanted_ = std::move(unwanted); }
    [[nodiscard]] bool cancelled() const {
        return cancelled_.load(std::memory_order_relaxed) || late() || (unwanted_ && unwanted_());
    }
    /// Whether the time of `cancel_at` has come.
    [[nodiscard]] bool late() const { return until_ != Clock::time_point::max() && Clock::now() >= until_; }

    /// Threads to use; 0 means all cores. Results do not depend on it.
    [[nodiscard]] unsigned threads() const { return threads_; }

    void report(const Progress& progress) const {
        if (on_progress_) on_progress_(progress);
    }

    /// The error every verb returns when it finds itself cancelled.
    [[nodiscard]] static Error cancelled_error() {
        return {Cause::kCancelled, "cancelled by the caller; nothing was changed", ""};
    }

private:
    ProgressHandler on_progress_;
    unsigned threads_ = 0;
    Clock::time_point until_ = Clock::time_point::max();
    std::function<bool()> unwanted_;
    std::atomic<bool> cancelled_{false};
};

}  // namespace vsplit
