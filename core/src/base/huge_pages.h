#pragma once

#include <cstddef>
#include <cstdint>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace vsplit {

/// Asks for large pages under memory that is about to be used, where it is large enough for some: who jumps about in many
/// megabytes otherwise waits for the tables that say where the small ones are. A wish; nothing depends on it.
inline void prefer_huge_pages([[maybe_unused]] void* begin, [[maybe_unused]] std::size_t bytes) {
#ifdef __linux__
    constexpr std::uintptr_t kHugePage = std::uintptr_t{1} << 21U;
    constexpr std::uintptr_t kMask = kHugePage - 1;
    const auto address = reinterpret_cast<std::uintptr_t>(begin);
    const std::uintptr_t first = (address + kMask) & ~kMask;
    const std::uintptr_t last = (address + bytes) & ~kMask;
    if (first < last) static_cast<void>(madvise(reinterpret_cast<void*>(first), last - first, MADV_HUGEPAGE));
#endif
}

}  // namespace vsplit
