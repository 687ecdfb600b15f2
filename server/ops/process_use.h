#pragma once

#include <cstddef>

namespace vsplit::ops {

/// What the process has of the machine; 0 where the operating system does not say.
struct ProcessUse {
    std::size_t resident_bytes = 0;
    std::size_t descriptors = 0;
    std::size_t most_descriptors = 0;
};

/// From /proc. O(descriptors).
[[nodiscard]] ProcessUse process_use();

}  // namespace vsplit::ops
