#pragma once

#include <cstddef>

#include "vsplit/base/expected.h"
#include "vsplit/mrr/multires_mesh.h"
#include "vsplit/v1/meshing.pb.h"

namespace vsplit::wire {

/// Parts that region_part cuts a representation's regions into; 0 where it has none. O(1).
[[nodiscard]] std::size_t region_parts(const MultiresMesh& mrr);

/// Part number `part`. \pre part < region_parts(mrr). O(256 KiB).
[[nodiscard]] v1::Regions region_part(const MultiresMesh& mrr, std::size_t part);

/// Adds a part to the regions and sets of `mrr`. \return OUT_OF_ORDER for one that does not follow the one before it; CORRUPT for
/// bytes that are no whole ids, or more ids than announced. What a part claims takes no memory.
[[nodiscard]] Status add_regions(const v1::Regions& part, MultiresMesh& mrr);

}  // namespace vsplit::wire
