#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "vsplit/base/expected.h"

namespace vsplit::store {

/// A mesh in the blob store and what is known of it, opaque here.
struct StoredItem {
    std::string blob;  ///< its key; empty: no mesh
    std::string info;
};

// Times are milliseconds: `created` since 1970, all others service time (service/session_archive.h).

struct SessionRow {
    std::uint64_t number = 0;
    std::string id;
    std::string owner;
    std::int64_t created = 0;
    std::int64_t expires = 0;
    std::uint64_t made = 0;
    StoredItem source;
    bool set_aside = false;  ///< it was damaged when it was last looked at
    bool sound = true;       ///< whether the row is as it was written
};

struct RepresentationRow {
    std::uint64_t session = 0;
    std::uint64_t number = 0;  ///< within the session, from 1
    StoredItem item;
    bool sound = true;  ///< as in SessionRow
};

struct JobRow {
    std::uint64_t number = 0;
    std::uint64_t session = 0;
    std::string info;
    bool sound = true;  ///< as in SessionRow
};

/// Everything, in order of numbers.
struct IndexContents {
    std::optional<std::int64_t> now;  ///< empty: it is not as it was written
    std::uint64_t last_session = 0;   ///< the largest number there ever was
    std::vector<SessionRow> sessions;
    std::vector<RepresentationRow> representations;
    std::vector<JobRow> jobs;
};

/// Which sessions there are and what is theirs. Thread-safe. Each call is done whole and for good when it returns success, or not
/// at all. They return LIMIT_EXCEEDED where the disk is full and UNAVAILABLE where it cannot be used; what else is said.
class SessionIndex {
public:
    SessionIndex() = default;
    virtual ~SessionIndex() = default;
    SessionIndex(const SessionIndex&) = delete;
    SessionIndex& operator=(const SessionIndex&) = delete;

    [[nodiscard]] virtual Expected<IndexContents> load() = 0;

    [[nodiscard]] virtual Status add_session(const SessionRow& session) = 0;

    /// Drops the session's representations and jobs. \return NOT_FOUND.
    [[nodiscard]] virtual Status set_source(std::uint64_t session, const StoredItem& source) = 0;

    /// `made`: the session's, from now on. \return NOT_FOUND.
    [[nodiscard]] virtual Status add_representation(const RepresentationRow& representation, std::uint64_t made) = 0;

    /// With all that is theirs.
    [[nodiscard]] virtual Status remove_sessions(const std::vector<std::uint64_t>& sessions) = 0;

    [[nodiscard]] virtual Status note_time(std::int64_t now,
                                           const std::vector<std::pair<std::uint64_t, std::int64_t>>& expire) = 0;

    /// \return its number; NOT_FOUND.
    [[nodiscard]] virtual Expected<std::uint64_t> add_job(std::uint64_t session, const std::string& info) = 0;
    [[nodiscard]] virtual Status remove_jobs(const std::vector<std::uint64_t>& jobs) = 0;

    /// Remembers that the session is damaged, and why, or, where `why` is empty, that it no longer is.
    [[nodiscard]] virtual Status set_aside(std::uint64_t session, const std::string& why) = 0;

    /// A blob that is about to be put is loose until a session has it.
    [[nodiscard]] virtual Status add_loose(const std::string& blob) = 0;

    /// Blobs that may go: that were put and no session had yet, or lost one that had them; and no session has them, of those set
    /// aside neither.
    [[nodiscard]] virtual Expected<std::vector<std::string>> loose() = 0;

    /// They are loose no more: they are gone, or a session has them.
    [[nodiscard]] virtual Status remove_loose(const std::vector<std::string>& blobs) = 0;

    /// Those of `blobs` that neither a session has nor is loose: the index knows nothing of them.
    [[nodiscard]] virtual Expected<std::vector<std::string>> unknown(const std::vector<std::string>& blobs) = 0;
};

}  // namespace vsplit::store
