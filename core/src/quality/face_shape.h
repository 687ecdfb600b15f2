#pragma once

namespace vsplit {

inline constexpr double kSqrt12 = 3.4641016151377544;

/// Stretch from the three edge lengths and twice the area: sqrt(12) * inradius / longest with inradius = 2 area / perimeter.
/// The one formula of Eq. 6 ([Date05]); exact for slivers, where Heron's form in the paper cancels. 0 for a point.
[[nodiscard]] inline double stretch_of(double length_a, double length_b, double length_c, double twice_area) {
    const double ab = length_a > length_b ? length_a : length_b;
    const double longest = ab > length_c ? ab : length_c;
    const double denominator = (length_a + length_b + length_c) * longest;
    return denominator > 0 ? kSqrt12 * twice_area / denominator : 0.0;
}

}  // namespace vsplit
