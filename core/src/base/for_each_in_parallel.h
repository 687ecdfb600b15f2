#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cstddef>

namespace vsplit {

/// visit(n) for each n below `count`, on any thread and in any order. For what is little work each.
template <class Visit>
void for_each_in_parallel(std::size_t count, Visit visit) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 4096), [&](const tbb::blocked_range<std::size_t>& range) {
        for (std::size_t n = range.begin(); n < range.end(); ++n) visit(n);
    });
}

}  // namespace vsplit
