#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "service/memory_budget.h"
#include "service/representation.h"
#include "service/source_mesh.h"
#include "vsplit/base/expected.h"

namespace vsplit::service {

/// A method that was asked for and has not ended.
struct UnfinishedMethod {
    std::uint64_t job = 0;  ///< its number in the archive
    MethodRequest request;
};

/// A session as an archive keeps it.
struct SessionRecord {
    std::uint64_t number = 0;  ///< orders sessions by creation; not used twice
    std::string id{};
    std::string owner{};
    std::chrono::system_clock::time_point create_time{};
    std::optional<std::chrono::milliseconds> expires{};  ///< in service time, see SessionArchive; empty: after its full time
    std::uint64_t made = 0;                              ///< representations ever
    std::shared_ptr<const SourceMesh> source{};
    std::vector<std::shared_ptr<const Representation>> representations{};
    std::vector<UnfinishedMethod> unfinished{};
};

/// A session that is damaged: it is kept and not served.
struct DamagedSession {
    std::uint64_t number = 0;  ///< as in SessionRecord
    std::string id;
    std::string owner;
    std::string why;
};

/// What an archive holds when a server begins.
struct Restored {
    std::vector<SessionRecord> sessions;  ///< by number
    std::uint64_t last_number = 0;        ///< the largest in use, also by what is not served
    std::chrono::milliseconds now{};      ///< service time
    std::vector<DamagedSession> damaged;
};

/// How much an archive holds.
struct ArchiveUse {
    std::uint64_t bytes = 0;
    std::uint64_t limit = 0;        ///< bytes; 0: none
    std::uint32_t set_aside = 0;    ///< sessions, and indices of sessions, that are damaged; they are kept and not served
    std::uint64_t blobs_aside = 0;  ///< files that no session has, and that are not deleted
    bool writable = true;           ///< whether the last that was to be written, at most a sweep ago, could be
};

/// Where sessions outlive the server. Thread-safe. Every call but `use` may wait for a disk.
///
/// Whatever a call has returned success for is there after any end of the process; of a call that failed or did not return
/// nothing is. What is given a source or a representation can load it again afterwards, so that it may leave memory.
///
/// Times are service time: how long servers of this archive have run, all together. A clock that is set and a server that is down
/// let no session expire.
///
/// This one keeps nothing.
class SessionArchive {
public:
    SessionArchive() = default;
    virtual ~SessionArchive() = default;
    SessionArchive(const SessionArchive&) = delete;
    SessionArchive& operator=(const SessionArchive&) = delete;

    /// All sessions; called once, first. `budget` outlives what is returned. \return what `disk_error` returns.
    [[nodiscard]] virtual Expected<Restored> restore(MemoryBudget& /*budget*/) { return Restored{}; }

    /// Keeps a new session and its source, if it has one. \return what `disk_error` returns.
    [[nodiscard]] virtual Status add(const SessionRecord& /*session*/) { return Done{}; }

    /// Replaces a session's source and drops its representations and unfinished methods. \return as `add`; NOT_FOUND.
    [[nodiscard]] virtual Status set_source(std::uint64_t /*session*/, const SourceMesh& /*source*/) { return Done{}; }

    /// Adds one more. `made` as in SessionRecord. \return as `add`; NOT_FOUND.
    [[nodiscard]] virtual Status add_representation(std::uint64_t /*session*/, const Representation& /*representation*/,
                                                    std::uint64_t /*made*/) {
        return Done{};
    }

    /// Forgets sessions and all that is theirs. Those that are not there are none. \return what `disk_error` returns.
    [[nodiscard]] virtual Status remove(const std::vector<std::uint64_t>& /*sessions*/) { return Done{}; }

    /// What time it is, and when the sessions of these numbers expire. \return what `disk_error` returns.
    [[nodiscard]] virtual Status note_time(std::chrono::milliseconds /*now*/,
                                           const std::vector<std::pair<std::uint64_t, std::chrono::milliseconds>>& /*expire*/) {
        return Done{};
    }

    /// A method begins. \return its number; NOT_FOUND, what `disk_error` returns.
    [[nodiscard]] virtual Expected<std::uint64_t> add_job(std::uint64_t /*session*/, const MethodRequest& /*request*/) {
        return std::uint64_t{0};
    }

    /// Methods that have ended. \return what `disk_error` returns.
    [[nodiscard]] virtual Status remove_jobs(const std::vector<std::uint64_t>& /*jobs*/) { return Done{}; }

    /// O(1).
    [[nodiscard]] virtual ArchiveUse use() const { return {}; }
};

}  // namespace vsplit::service
