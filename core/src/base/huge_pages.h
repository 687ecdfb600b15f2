#pragma once

#include <cstddef>
#include <memory>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace vsplit {

/// Asks for large pages under memory that is about to be used, where it is large enough for some: who jumps about in many
/// megabytes otherwise waits for the tables that say where the small ones are. A wish; nothing depends on it.
inline void prefer_huge_pages([[maybe_unused]] void* begin, [[maybe_unused]] std::size_t bytes) {
#ifdef __linux__
    constexpr std::size_t kHugePage = std::size_t{1} << 21U;
    std::size_t room = bytes;
    if (std::align(kHugePage, kHugePage, begin, room) != nullptr)
        static_cast<void>(madvise(begin, room / kHugePage * kHugePage, MADV_HUGEPAGE));
#endif
}

}  // namespace vsplit
