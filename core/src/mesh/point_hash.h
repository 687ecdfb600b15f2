#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// Hashes three doubles to 32 bits; -0 hashes as 0 does.
///
/// Multilinear hashing with keys drawn at random once a process is strongly universal: nobody can make a file whose vertices
/// all fall on one slot and make the weld quadratic. Which vertices are equal does not depend on the keys, so results do not.
class PointHash {
public:
    PointHash();

    [[nodiscard]] std::uint32_t operator()(const Vec3& point) const {
        std::uint64_t sum = keys_[6];
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto bits = std::bit_cast<std::uint64_t>(point[static_cast<Eigen::Index>(axis)] + 0.0);
            sum += keys_[2 * axis] * (bits & 0xFFFFFFFF) + keys_[2 * axis + 1] * (bits >> 32);
        }
        return static_cast<std::uint32_t>(sum >> 32);
    }

    /// Of two numbers, in the same way.
    [[nodiscard]] std::uint32_t operator()(std::uint32_t a, std::uint32_t b) const {
        return static_cast<std::uint32_t>((keys_[6] + keys_[0] * a + keys_[1] * b) >> 32);
    }

private:
    std::array<std::uint64_t, 7> keys_;
};

}  // namespace vsplit
