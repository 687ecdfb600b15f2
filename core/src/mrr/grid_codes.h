#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "mesh/coordinate.h"
#include "vsplit/mrr/position_grid.h"

namespace vsplit {

/// The exponent field of a double: floor(log2) + 1023 of a normal one, 0 of zero.
[[nodiscard]] inline int exponent_field(double value) {
    return static_cast<int>(std::bit_cast<std::uint64_t>(value) >> 52U & 0x7FFU);
}

/// g++ 12.2 leaves the rounding out where three doubles beside each other become floats and doubles again (its pass for straight
/// vector code does; tests/core/position_grid_test.cpp); it does not dare to where the float is volatile.
[[nodiscard]] inline float rounded_to_float(double value) {
    const volatile float rounded = static_cast<float>(value);
    return rounded;
}

inline constexpr int kScales = 32;

/// Coordinates of a grid as whole numbers in their order, so that near values have near numbers. Scales (0 .. 31) say how many
/// numbers a length spans, as a power of two.
class Float32Codes {
public:
    explicit Float32Codes(const PositionGrid& /*grid*/) {}

    [[nodiscard]] static std::uint32_t code(double value, unsigned /*axis*/) {
        const auto bits = std::bit_cast<std::uint32_t>(rounded_to_float(value));
        return bits ^ ((0U - (bits >> 31U)) | 0x80000000U);
    }
    [[nodiscard]] static double value(std::uint32_t code, unsigned /*axis*/) {
        return std::bit_cast<float>(code ^ (((code >> 31U) - 1U) | 0x80000000U));
    }
    /// Whether it is that of a coordinate a mesh may have.
    [[nodiscard]] static bool holds(std::uint32_t code) { return is_valid_coordinate(value(code, 0)); }
    /// Floats have 23 bits after the first: one near `at` is 2^-23 of it wide.
    [[nodiscard]] static unsigned scale(double length, double at) {
        if (length == 0) return 0;
        return static_cast<unsigned>(std::clamp(exponent_field(length) - exponent_field(at) + 24, 0, kScales - 1));
    }
};

class QuantisedCodes {
public:
    explicit QuantisedCodes(const PositionGrid& grid)
        : origin_{grid.origin().x(), grid.origin().y(), grid.origin().z()},
          step_(grid.step()),
          per_unit_(1 / grid.step()),
          most_code_((std::uint32_t{1} << grid.bits()) - 1),
          most_(most_code_) {}

    [[nodiscard]] std::uint32_t code(double value, unsigned axis) const {
        const double upper =
            (value - origin_[axis]) * per_unit_ + 0.5;  // its floor is the nearest; of one not below 0, its whole part
        return static_cast<std::uint32_t>(std::min(std::max(upper, 0.0), most_));
    }
    [[nodiscard]] double value(std::uint32_t code, unsigned axis) const { return origin_[axis] + code * step_; }
    [[nodiscard]] unsigned scale(double length, double /*at*/) const {
        return static_cast<unsigned>(std::clamp(exponent_field(length * per_unit_) - 1022, 0, kScales - 1));
    }
    [[nodiscard]] bool holds(std::uint32_t code) const { return code <= most_code_; }

private:
    double origin_[3];
    double step_;
    double per_unit_;
    std::uint32_t most_code_;
    double most_;
};

}  // namespace vsplit
