#pragma once

#include <cstdint>
#include <vector>

#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// The vertices at the corners of all faces one after the other, as half-edges count them: no division for a look at one.
static_assert(sizeof(Triangle) == 3 * sizeof(std::uint32_t));
[[nodiscard]] inline const std::uint32_t* corners_of(const std::vector<Triangle>& faces) { return faces.data()->data(); }
[[nodiscard]] inline std::uint32_t* corners_of(std::vector<Triangle>& faces) { return faces.data()->data(); }

}  // namespace vsplit
