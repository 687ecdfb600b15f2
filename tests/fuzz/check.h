#pragma once

#include <cstdio>
#include <cstdlib>

namespace vsplit::fuzz {

/// Ends the program, as a finding, when what must always hold does not; in builds without asserts too.
inline void check(bool holds, const char* what) {
    if (holds) return;
    std::fprintf(stderr, "does not hold: %s\n", what);
    std::abort();
}

}  // namespace vsplit::fuzz
