#pragma once

#include <cstdint>

#include "vsplit/mrr/multires_mesh.h"

namespace vsplit {

/// How much an MRR holds, for who does not have it at hand.
struct MrrExtent {
    std::uint32_t faces_min = 0;
    std::uint32_t faces_max = 0;
    std::uint32_t splits = 0;
    std::uint32_t flips = 0;
    std::uint32_t moves = 0;

    friend bool operator==(const MrrExtent&, const MrrExtent&) = default;
};

/// O(log(border_splits)).
[[nodiscard]] MrrExtent extent_of(const MultiresMesh& mrr);

}  // namespace vsplit
