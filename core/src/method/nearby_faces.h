#pragma once

#include <cstdint>

#include "vsplit/method/method_options.h"
#include "vsplit/mrr/multires_mesh.h"

namespace vsplit {

/// The faces of a resolution at which all bounds of `options` hold: that nearest to options.faces where they do, else the first
/// of others tried, ever further away to either side, finer first; else options.faces. `given`: the user named the faces, and 10
/// % more or less are near enough; else any finer resolution will do and those down to half the faces, with min_size all. Tries
/// some 2 log2(levels), each in O(faces).
[[nodiscard]] std::uint32_t faces_that_keep_bounds(const MultiresMesh& mrr, const ControlOptions& options, bool given);

}  // namespace vsplit
