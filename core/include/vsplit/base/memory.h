#pragma once

#include <cstdlib>  // says whether this is glibc

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace vsplit {

/// Whole meshes and files come and go: after this, memory taken a megabyte at a time or more goes back to the system when it is
/// freed, where glibc would learn to keep it. For programs to call before they start; a library does not set this for others.
inline void return_large_memory() {
#if defined(__GLIBC__)
    constexpr int kLarge = 1 << 20;
    static_cast<void>(mallopt(M_MMAP_THRESHOLD, kLarge));
#endif
}

}  // namespace vsplit
