#pragma once

#include "service/limits.h"
#include "service/memory_budget.h"
#include "service/session_archive.h"
#include "service/worker_pool.h"

namespace vsplit::service {

/// What all sessions of a server share. It outlives them.
struct SessionHost {
    const ServiceOptions& options;
    MemoryBudget& memory;
    SessionArchive& archive;
    WorkerPool& workers;  ///< for methods
};

}  // namespace vsplit::service
