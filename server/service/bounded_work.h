#pragma once

#include <functional>
#include <string>
#include <utility>

#include "service/limits.h"
#include "vsplit/base/execution_context.h"

namespace vsplit::service {

/// Whether somebody waits for an answer. Asked often, from any thread.
using StillWanted = std::function<bool()>;

inline bool always_wanted() { return true; }

/// What ends work that went on for longer than Limits::job_seconds. `what` is its subject, as "the method".
[[nodiscard]] inline Error took_too_long(const std::string& what, const Limits& limits) {
    return {Cause::kLimitExceeded,
            what + " ran for " + std::to_string(limits.job_seconds) + " s, the server's limit max_job_seconds; ask for less", ""};
}

/// What heavy work for a caller runs in: it ends when its time is over, and when nobody waits for it.
class BoundedWork {
public:
    /// \param what its subject, as "the method". `limits` outlives this.
    BoundedWork(std::string what, const Limits& limits, StillWanted wanted) : what_(std::move(what)), limits_(limits) {
        context_.cancel_at(ExecutionContext::Clock::now() + std::chrono::seconds(limits.job_seconds));
        context_.cancel_when([wanted = std::move(wanted)] { return !wanted(); });
    }

    [[nodiscard]] const ExecutionContext& context() const { return context_; }

    /// The error that a verb ended with, with the limit by its name where that was why.
    [[nodiscard]] Error explained(Error error) const {
        return error.cause == Cause::kCancelled && context_.late() ? took_too_long(what_, limits_) : std::move(error);
    }

private:
    const std::string what_;
    const Limits& limits_;
    ExecutionContext context_;
};

}  // namespace vsplit::service
