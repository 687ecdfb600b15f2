#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "service/job_queue.h"
#include "service/limits.h"
#include "service/session_snapshot.h"
#include "vsplit/base/expected.h"

namespace vsplit::service {

/// A mesh, the representations made from it, and the jobs that make them. Thread-safe; no call takes long.
class Session {
public:
    /// `source` may be null. `number` orders sessions by creation.
    Session(std::string id, std::uint64_t number, std::shared_ptr<const SourceMesh> source, const ServiceOptions& options,
            WorkerPool& workers, std::string owner = {});

    /// Who made it; nobody else sees it.
    [[nodiscard]] const std::string& owner() const { return owner_; }
    [[nodiscard]] const std::string& id() const { return id_; }
    [[nodiscard]] std::uint64_t number() const { return number_; }
    [[nodiscard]] SessionSnapshot snapshot() const;

    /// A use: the session lives its full time again.
    void touch();

    /// Unused for longer than its time, with no job that runs or waits.
    [[nodiscard]] bool expired() const;

    /// Whether `set_source` could be done now. \return BUSY, NOT_FOUND when closed.
    [[nodiscard]] Status require_idle() const;

    /// Replaces the mesh and drops all representations. \return as `require_idle`.
    [[nodiscard]] Status set_source(std::shared_ptr<const SourceMesh> source);

    /// The same for a mesh that was made from `before`. \return also BUSY where that is no longer the session's.
    [[nodiscard]] Status replace_source(const std::shared_ptr<const SourceMesh>& before,
                                        std::shared_ptr<const SourceMesh> source);

    /// \return NOT_FOUND when closed.
    [[nodiscard]] Expected<SessionSnapshot::RepresentationPointer> add_representation(MeshRef source, MethodResult result);

    using MakeJob = std::function<Expected<std::shared_ptr<Job>>(const SessionSnapshot&)>;

    /// Makes a job of the session as it stands and queues it, with no upload in between.
    /// \return what `make` and JobQueue::push return; LIMIT_EXCEEDED when there are too many representations.
    [[nodiscard]] Expected<std::shared_ptr<Job>> enqueue(const MakeJob& make);

    /// See JobQueue::cancel.
    void cancel(const std::shared_ptr<Job>& job, const Error& why) { queue_->cancel(job, why); }

    /// Jobs that wait for another one of this session.
    [[nodiscard]] std::size_t waiting_jobs() const { return queue_->waiting(); }

    /// Cancels all jobs; nothing can be put into the session any more.
    void close(const Error& why);

private:
    using Clock = std::chrono::steady_clock;

    [[nodiscard]] SessionSnapshot snapshot_locked() const;
    [[nodiscard]] Status require_open_locked() const;
    [[nodiscard]] Status require_idle_locked() const;
    [[nodiscard]] Status set_source_locked(std::shared_ptr<const SourceMesh>& source,
                                           std::vector<SessionSnapshot::RepresentationPointer>& dropped);

    const std::string id_;
    const std::string owner_;
    const std::uint64_t number_;
    const ServiceOptions options_;
    const std::chrono::system_clock::time_point create_time_ = std::chrono::system_clock::now();
    const std::shared_ptr<JobQueue> queue_;

    // Taken before the queue's own lock, never after it.
    mutable std::mutex mutex_;
    Clock::time_point expires_;
    bool closed_ = false;
    std::shared_ptr<const SourceMesh> source_;
    std::vector<SessionSnapshot::RepresentationPointer> representations_;
    std::uint64_t made_ = 0;  // representations ever; ids are not used twice, so that an old one never shows another mesh
};

}  // namespace vsplit::service
