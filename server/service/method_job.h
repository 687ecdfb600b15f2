#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "service/caller.h"
#include "service/job_note.h"
#include "service/job_queue.h"
#include "service/job_record.h"
#include "service/progress_gate.h"
#include "service/session.h"
#include "vsplit/base/execution_context.h"

namespace vsplit::service {

/// What a method made, in memory.
struct MadeRepresentation {
    SessionSnapshot::RepresentationPointer representation;
    std::shared_ptr<const Levels> levels;  ///< its own
};

using JobOutcome = Expected<MadeRepresentation>;

/// Who hears of a job. Called without any lock held, from whatever thread; must not block.
struct JobEvents {
    std::function<void()> on_noted;                    ///< once, first: should the server end now, that will be known
    std::function<void(const Progress&)> on_progress;  ///< at most about 20 a second
    std::function<void(const JobOutcome&)> on_done;    ///< once, last; the session is free for the next by then
};

/// What all methods of a server share. It outlives them.
struct MethodHost {
    const ServiceOptions& options;
    MemoryBudget& memory;
    WorkerPool& disk;  ///< for what waits for a disk and nobody waits for
};

/// One Improve or Control in its session's queue.
class MethodJob final : public Job {
public:
    /// Of `request`, whose source is `source`. `note` is erased at its end.
    MethodJob(std::shared_ptr<Session> session, PickedMesh source, MethodRequest request, const MethodHost& host,
              std::shared_ptr<JobNote> note, JobEvents events, const Caller& caller);

    [[nodiscard]] Report run() override;
    void stop(const Error& why) override;
    void abandon(const Error& why) override;

private:
    [[nodiscard]] JobOutcome compute();
    [[nodiscard]] JobOutcome make(const MethodRequest& request, const TriangleMesh& mesh);
    [[nodiscard]] Status make_room(std::uint64_t faces);
    void end_note(const JobOutcome& outcome) const;
    [[nodiscard]] Expected<MethodResult> apply(const ImproveOptions& options, const TriangleMesh& mesh);
    [[nodiscard]] Expected<MethodResult> apply(const ControlOptions& options, const TriangleMesh& mesh);
    [[nodiscard]] std::uint64_t faces_in_memory() const;
    [[nodiscard]] MethodLimits limits();
    [[nodiscard]] Error explained(Error error) const;
    [[nodiscard]] std::optional<Error> stopped() const;
    [[nodiscard]] Error why_cancelled() const;
    void tell(const Progress& progress);
    void record(const JobOutcome& outcome, std::chrono::steady_clock::time_point began) const;

    std::shared_ptr<Session> session_;
    const PickedMesh source_;
    const MethodRequest request_;
    const MethodHost host_;
    const JobEvents events_;
    const std::shared_ptr<JobNote> note_;
    const CallMark mark_;
    const std::chrono::steady_clock::time_point asked_ = std::chrono::steady_clock::now();
    ProgressGate gate_;
    ExecutionContext context_;
    MemoryBudget::Share room_;    // while it runs
    std::uint32_t faces_in_ = 0;  // once they are known
    mutable std::mutex mutex_;
    std::optional<Error> why_stopped_;
};

}  // namespace vsplit::service
