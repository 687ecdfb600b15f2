#pragma once

#include <cstdint>
#include <limits>

#include "quality/face_bounds.h"
#include "quality/flip_rules.h"
#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// What flips and moves must keep to.
struct PolishLimits {
    Vec3 centre = Vec3::Zero();  ///< quadrics are of points relative to it
    double tolerance = 0;        ///< length: of a move's quadric error, and of the gap a flip may open or close
    double max_size = std::numeric_limits<double>::infinity();  ///< longest edge
    double crease_cosine = -1;                                  ///< of the angle from which on a crease counts as one
    std::uint32_t max_valence = std::numeric_limits<std::uint32_t>::max();
    FaceBounds bounds{};
};

}  // namespace vsplit
