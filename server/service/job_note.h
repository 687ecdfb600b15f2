#pragma once

#include <cstdint>
#include <mutex>
#include <optional>

#include "service/method_request.h"
#include "service/session_archive.h"

namespace vsplit::service {

/// What the archive knows of a method while it waits and runs, so that one which the end of the server cuts off is known
/// afterwards. Thread-safe. Both calls may wait for the archive, so they come from a pool and not from who has the method; in
/// whatever order they come, nothing is left when both are done.
class JobNote {
public:
    /// `archive` outlives this.
    JobNote(SessionArchive& archive, std::uint64_t session, MethodRequest request);

    /// The method was asked for.
    void write();

    /// The method has ended.
    void erase();

private:
    SessionArchive& archive_;
    const std::uint64_t session_;
    const MethodRequest request_;
    std::mutex mutex_;  // held while the archive is called: the two must not overtake each other
    std::optional<std::uint64_t> job_;
    bool ended_ = false;
};

}  // namespace vsplit::service
