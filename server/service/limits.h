#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "service/job_record.h"

namespace vsplit::service {

/// When to try again after a limit on what the server does and holds at a time, seconds.
inline constexpr unsigned kRetryAfter = 5;

/// What a client may use up. Each of these is a flag of vsplitd; going beyond one is LIMIT_EXCEEDED and names it.
struct Limits {
    std::uint64_t upload_bytes = std::uint64_t{4} << 30;  ///< of one uploaded file
    std::uint32_t faces = 20'000'000;                     ///< of an uploaded mesh
    std::uint32_t faces_subdivided = 20'000'000;          ///< of a mesh after subdivision
    std::uint32_t sessions = 1000;                        ///< at a time
    std::uint32_t sessions_by_client = 100;               ///< of one token, at a time
    std::uint32_t representations = 32;                   ///< of a session
    std::uint32_t waiting_jobs = 8;                       ///< of a session, besides the one that runs
    std::uint32_t queued_jobs = 1000;                     ///< of all sessions, for a worker or for another of their session
    std::uint32_t job_seconds = 3600;                     ///< that one method runs
    std::uint64_t disk_bytes = 0;                         ///< of the archive and of uploads on their way; 0: no limit
    std::uint64_t memory_bytes = 0;                       ///< of meshes, representations and methods together; 0: no limit
};

struct ServiceOptions {
    Limits limits;
    unsigned workers = 0;                                           ///< methods that run at a time; 0: one a core
    unsigned threads = 1;                                           ///< threads of one method; 0: all cores
    std::chrono::milliseconds session_ttl = std::chrono::hours(1);  ///< an unused session lives this long
    std::filesystem::path temp_directory{};                         ///< for unnamed files; empty: $TMPDIR or /tmp
    JobObserver job_observer{};                                     ///< for metrics and the log
    std::function<void(const std::string& session)> on_expired{};   ///< as above; must not block
};

}  // namespace vsplit::service
