#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "service/caller.h"
#include "service/job_queue.h"
#include "service/job_record.h"
#include "service/progress_gate.h"
#include "service/session.h"
#include "vsplit/base/execution_context.h"

namespace vsplit::service {

using JobOutcome = Expected<SessionSnapshot::RepresentationPointer>;

/// Who hears of a job. Called without any lock held, from whatever thread; must not block.
struct JobEvents {
    std::function<void(const Progress&)> on_progress;  ///< at most about 20 a second
    std::function<void(const JobOutcome&)> on_done;    ///< once, last; the session is free for the next by then
};

/// One Improve or Control in its session's queue.
class MethodJob final : public Job {
public:
    MethodJob(std::shared_ptr<Session> session, PickedMesh source, const MethodOptions& options, const ServiceOptions& service,
              JobEvents events, const Caller& caller);

    [[nodiscard]] Report run() override;
    void stop(const Error& why) override;
    void abandon(const Error& why) override;

private:
    [[nodiscard]] JobOutcome compute();
    [[nodiscard]] Expected<MethodResult> apply(const ImproveOptions& options, const TriangleMesh& mesh);
    [[nodiscard]] Expected<MethodResult> apply(const ControlOptions& options, const TriangleMesh& mesh);
    [[nodiscard]] std::optional<Error> stopped() const;
    void tell(const Progress& progress);
    void record(const JobOutcome& outcome, std::chrono::steady_clock::time_point began) const;

    std::shared_ptr<Session> session_;
    const PickedMesh source_;
    const MethodOptions options_;
    const MethodLimits limits_;
    const JobEvents events_;
    const JobObserver observer_;
    const std::string request_id_;
    const std::chrono::steady_clock::time_point asked_ = std::chrono::steady_clock::now();
    ProgressGate gate_;
    ExecutionContext context_;
    mutable std::mutex mutex_;
    std::optional<Error> why_stopped_;
};

}  // namespace vsplit::service
