#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "service/job_queue.h"
#include "service/session_host.h"
#include "service/session_snapshot.h"
#include "vsplit/base/expected.h"

namespace vsplit::service {

/// A mesh, the representations made from it, and the jobs that make them. Thread-safe; no call takes long but those that wait for
/// the archive. Nothing is seen of a change before the archive has it.
class Session {
public:
    using Clock = std::chrono::steady_clock;

    /// A session that `host.archive` has. `began`: when service time began.
    Session(SessionRecord record, Clock::time_point began, const SessionHost& host);

    /// Who made it; nobody else sees it.
    [[nodiscard]] const std::string& owner() const { return owner_; }
    [[nodiscard]] const std::string& id() const { return id_; }
    [[nodiscard]] std::uint64_t number() const { return number_; }
    [[nodiscard]] SessionSnapshot snapshot() const;

    /// A use: the session lives its full time again.
    void touch();

    /// Unused for longer than its time, with no job that runs or waits.
    [[nodiscard]] bool expired() const;

    /// The session does not expire while what this returns is there.
    [[nodiscard]] static std::shared_ptr<void> hold(const std::shared_ptr<Session>& session);

    /// When it expires, where that was put off since it was asked last.
    [[nodiscard]] std::optional<Clock::time_point> take_expiry();

    /// What take_expiry returned could not be told: it returns it again.
    void put_expiry_back();

    /// Whether `set_source` could be done now. \return BUSY, NOT_FOUND when closed.
    [[nodiscard]] Status require_idle() const;

    /// Replaces the mesh and drops all representations. May wait for the archive.
    /// \return as `require_idle`; what SessionArchive::set_source returns.
    [[nodiscard]] Status set_source(std::shared_ptr<const SourceMesh> source);

    /// The same for a mesh that was made from `before`. \return also BUSY where that is no longer the session's.
    [[nodiscard]] Status replace_source(const std::shared_ptr<const SourceMesh>& before,
                                        std::shared_ptr<const SourceMesh> source);

    /// Whether there may be one more representation. \return LIMIT_EXCEEDED.
    [[nodiscard]] Status require_room() const;

    /// What was made for the same request before, if it was. O(representations).
    [[nodiscard]] SessionSnapshot::RepresentationPointer find_made(const MethodRequest& request) const;

    /// May wait for the archive. \pre a job of this session runs, and calls it.
    /// \return NOT_FOUND when closed; LIMIT_EXCEEDED when there are too many; what SessionArchive::add_representation returns.
    [[nodiscard]] Expected<SessionSnapshot::RepresentationPointer> add_representation(const MethodRequest& request,
                                                                                      MethodResult result);

    /// A method that was cut off before has been asked for again, and what it makes is there. May wait for the archive.
    void answered(const MethodRequest& request);

    using MakeJob = std::function<Expected<std::shared_ptr<Job>>(const SessionSnapshot&)>;

    /// Makes a job of the session as it stands and queues it, with no upload in between.
    /// \return what `make` and JobQueue::push return; BUSY while an upload is put in; LIMIT_EXCEEDED when there are too many
    /// representations, none of which was made with `options`.
    [[nodiscard]] Expected<std::shared_ptr<Job>> enqueue(const MethodOptions& options, const MakeJob& make);

    /// See JobQueue::cancel.
    void cancel(const std::shared_ptr<Job>& job, const Error& why) { queue_->cancel(job, why); }

    /// Jobs that wait for another one of this session.
    [[nodiscard]] std::size_t waiting_jobs() const { return queue_->waiting(); }

    /// Cancels all jobs; nothing can be put into the session any more. Where `why` is UNAVAILABLE, who tries is told that.
    void close(const Error& why);

private:
    using Pointers = std::vector<SessionSnapshot::RepresentationPointer>;

    [[nodiscard]] SessionSnapshot snapshot_locked() const;
    [[nodiscard]] Status require_open_locked() const;
    [[nodiscard]] Status require_idle_locked() const;
    [[nodiscard]] Status require_room_locked() const;
    [[nodiscard]] Status begin_change(const SourceMesh* before);
    [[nodiscard]] Status change_source(const SourceMesh* before, std::shared_ptr<const SourceMesh>& source);

    const std::string id_;
    const std::string owner_;
    const std::uint64_t number_;
    const SessionHost host_;
    const std::chrono::system_clock::time_point create_time_;
    const std::shared_ptr<JobQueue> queue_;

    // Taken before the queue's own lock, never after it; not held while the archive is called.
    mutable std::mutex mutex_;
    Clock::time_point expires_;
    bool used_ = false;  // since take_expiry
    int held_ = 0;
    std::optional<Error> closed_;
    bool changing_ = false;  // an upload is on its way into the archive
    std::shared_ptr<const SourceMesh> source_;
    Pointers representations_;
    std::vector<UnfinishedMethod> unfinished_;  // of servers before this one
    std::uint64_t made_ = 0;  // representations ever; ids are not used twice, so that an old one never shows another mesh
};

}  // namespace vsplit::service
