#pragma once

#include <cstdint>
#include <vector>

#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit::test {

/// A round feature to put on a plate.
struct Drilling {
    double diameter = 0;
    double depth = 0;  ///< of a hole from the top, the plate's thickness for a through hole; negative: the height of a boss
    std::uint32_t sides = 24;  ///< divisible by 4
};

/// A plate of squares of side `pitch`, its top at z = 0, with a drilling in the middle of each square, by rows from the origin;
/// tessellated as CAD does: faces as long as they can be, fans, slivers. Closed, manifold. Square (c, r) begins at
/// (c * pitch, r * pitch).
[[nodiscard]] TriangleMesh drilled_plate(std::uint32_t columns, double pitch, double thickness,
                                         const std::vector<Drilling>& drillings);

/// Forty drillings of diameters from 2 to 6: through holes, and each fourth a blind one, for a plate of pitch 10 and `thickness`.
[[nodiscard]] std::vector<Drilling> forty_drillings(double thickness);

/// The area of a regular polygon of so many sides in a circle of this diameter.
[[nodiscard]] double polygon_area(double diameter, std::uint32_t sides);

}  // namespace vsplit::test
