#pragma once

#include <tbb/info.h>
#include <tbb/task_arena.h>

#include <algorithm>

#include "vsplit/base/execution_context.h"

namespace vsplit {

/// Runs `work` so that everything parallel in it takes at most the context's threads. `work` itself stays on the calling thread.
template <class Work>
auto with_thread_limit(const ExecutionContext& context, const Work& work) {
    const int cores = tbb::info::default_concurrency();
    tbb::task_arena arena(context.threads() == 0 ? cores
                                                 : std::min(cores, static_cast<int>(std::min(context.threads(), 1U << 16U))));
    return arena.execute(work);
}

}  // namespace vsplit
