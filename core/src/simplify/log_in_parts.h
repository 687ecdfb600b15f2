#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>

#include <cstddef>
#include <utility>
#include <vector>

#include "simplify/collapse_log.h"
#include "simplify/mesh_parts.h"

namespace vsplit {

/// Calls `work(part)` for each part, on any thread.
template <class Work>
void in_parallel(std::size_t parts, Work work) {
    const auto work_at = [&](const tbb::blocked_range<std::size_t>& range) {
        for (std::size_t part = range.begin(); part < range.end(); ++part) work(part);
    };
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, parts, 1), work_at, tbb::simple_partitioner());
}

/// Calls `work(part, log)` for each part; then `log` has what they all told, part by part.
template <class Work>
void log_in_parts(const MeshParts& parts, const HalfEdgeMesh& mesh, CollapseLog& log, Work work) {
    std::vector<CollapseLog> logs;
    for (std::size_t part = 0; part < parts.count(); ++part) logs.push_back(log.fork(mesh));
    in_parallel(parts.count(), [&](std::size_t part) { work(part, logs[part]); });
    for (CollapseLog& part : logs) log.append(std::move(part));
}

}  // namespace vsplit
