#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string_view>

#include "service/caller.h"
#include "service/limits.h"
#include "service/method_job.h"
#include "service/session_store.h"
#include "service/sweeper.h"
#include "service/upload.h"
#include "service/worker_pool.h"

namespace vsplit::service {

/// A method that was begun, to cancel it by.
struct RunningMethod {
    std::shared_ptr<Session> session;
    std::shared_ptr<Job> job;
};

/// How much there is to do.
struct ServiceLoad {
    std::size_t sessions = 0;
    std::size_t methods_running = 0;
    std::size_t methods_waiting = 0;  ///< for a worker, or for another method of their session
    MemoryBudget::Use memory{};
    ArchiveUse archive{};
    std::uint64_t disk_free = 0;  ///< bytes of the file system that uploads, and the archive's files, are on
};

/// Everything a front door needs, whatever it speaks. Thread-safe. Functions marked heavy are for a pool, the others return at
/// once. A session is found by a caller with the owner that it was made for.
class MeshingService {
public:
    /// Without an archive sessions end with the service. \pre `archive` is not null.
    explicit MeshingService(const ServiceOptions& options,
                            std::unique_ptr<SessionArchive> archive = std::make_unique<SessionArchive>());
    ~MeshingService();
    MeshingService(const MeshingService&) = delete;
    MeshingService& operator=(const MeshingService&) = delete;

    [[nodiscard]] const ServiceOptions& options() const { return options_; }
    [[nodiscard]] SessionStore& sessions() { return sessions_; }
    [[nodiscard]] MemoryBudget& memory() { return memory_; }

    /// Takes over the sessions of the archive. Once, before anything else. \return what SessionArchive::restore returns.
    [[nodiscard]] Status restore() { return sessions_.restore(); }

    /// Whoever calls it a use of the session. \return NOT_FOUND.
    [[nodiscard]] Expected<SessionSnapshot> snapshot(std::string_view session, const Caller& caller = {});

    /// A use of the session that outlives the process. May wait for the archive.
    /// \return NOT_FOUND, what SessionArchive::note_time returns.
    [[nodiscard]] Expected<SessionSnapshot> keep_alive(std::string_view session, const Caller& caller = {});

    /// An empty session. May wait for the archive. \return LIMIT_EXCEEDED, what SessionArchive::add returns.
    [[nodiscard]] Expected<SessionSnapshot> create_session(const Caller& caller = {});

    /// A session with a mesh, or none at all. Heavy: for `intake`. \return LIMIT_EXCEEDED, naming mesh where it is too large,
    /// what `check_settings` and `read_source` return.
    [[nodiscard]] Expected<SessionSnapshot> create_session(std::span<const std::byte> bytes, const MeshSettings& settings,
                                                           const Caller& caller = {}, const StillWanted& wanted = always_wanted);

    /// \return NOT_FOUND, what Upload::begin returns.
    [[nodiscard]] Expected<Upload> begin_upload(std::string_view session, const UploadSettings& settings,
                                                const Caller& caller = {});

    /// Queues a method. `events` hear of it from now on, perhaps before this returns.
    /// \return NOT_FOUND, NOT_READY, LIMIT_EXCEEDED, what `check_options` and `require_manifold` return; no event then.
    [[nodiscard]] Expected<RunningMethod> start(std::string_view session, const MethodRequest& request, JobEvents events,
                                                const Caller& caller = {});

    /// Runs something heavy for a reader, on a thread of its own kind: no method and no mesh that comes in keeps it waiting.
    /// False when shut down.
    [[nodiscard]] bool errand(WorkerPool::Task task) { return errands_.submit(std::move(task)).has_value(); }

    /// As `errand`, for a mesh that comes in.
    [[nodiscard]] bool intake(WorkerPool::Task task) { return intake_.submit(std::move(task)).has_value(); }

    /// As `errand`, for what waits for the disk.
    [[nodiscard]] bool disk_errand(WorkerPool::Task task) { return disk_.submit(std::move(task)).has_value(); }

    /// O(sessions). Asks the file system.
    [[nodiscard]] ServiceLoad load() const;

    /// The server ends: forgets all sessions, which the archive keeps, and stops their methods, whose events are called with
    /// UNAVAILABLE. The archive remembers these methods as cut off. May wait for the archive.
    void end_sessions();

    /// end_sessions, and waits for the last worker. No event comes afterwards.
    void shutdown();

private:
    [[nodiscard]] Status require_room_in_queue() const;

    void sweep();

    const ServiceOptions options_;
    MemoryBudget memory_;
    const std::unique_ptr<SessionArchive> archive_;
    UploadRoom upload_room_;
    WorkerPool methods_;
    WorkerPool errands_;
    WorkerPool intake_;
    WorkerPool disk_;
    SessionStore sessions_;
    Sweeper sweeper_;
};

}  // namespace vsplit::service
