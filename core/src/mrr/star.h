#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "mesh/half_edges.h"
#include "vsplit/mrr/progressive_mesh.h"

namespace vsplit {

using Offset = std::array<double, 3>;

/// A vertex and its ring, counter-clockwise from the nearest neighbour on (of several the one with the lowest number): an order
/// that depends on the mesh alone, not on how it was reached. Sums over it are made in this order, so they are the same bits
/// wherever they are made.
class Star {
public:
    void gather(const ProgressiveMesh& mesh, std::uint32_t vertex) {
        const auto& positions = mesh.mesh().positions;
        for (int axis = 0; axis < 3; ++axis) centre[axis] = positions[vertex][axis];
        const HalfEdge start = mesh.corner_of(vertex);
        HalfEdge corner = start;
        double least = std::numeric_limits<double>::infinity();
        std::uint32_t nearest = kNone;  // vertex
        valence_ = 0;
        do {
            if (2 * valence_ + 2 > spokes_.size()) spokes_.resize(2 * spokes_.size() + 32);
            Spoke& spoke = spokes_[valence_];
            spoke.corner = corner;
            spoke.vertex = origin(mesh.mesh(), next(corner));
            const Vec3& at = positions[spoke.vertex];
            for (int axis = 0; axis < 3; ++axis) spoke.offset[axis] = at[axis] - centre[axis];
            const Offset& d = spoke.offset;
            const double square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
            // Nobody can foresee which is the nearest, so this is selected, not branched to.
            const bool nearer = (square < least) | ((square == least) & (spoke.vertex < nearest));
            first_ = nearer ? valence_ : first_;
            nearest = nearer ? spoke.vertex : nearest;
            least = nearer ? square : least;
            ++valence_;
            corner = mesh.twins()[prev(corner)];
        } while (corner != start);
        std::copy_n(spokes_.begin(), valence_, spokes_.begin() + valence_);
    }

    /// Begins the ring `steps` later. \pre steps < valence().
    void turn(std::uint32_t steps) {
        first_ += steps;
        if (first_ >= valence_) first_ -= valence_;
    }

    struct Spoke {
        HalfEdge corner = 0;       ///< of the centre, in the face after the neighbour
        std::uint32_t vertex = 0;  ///< the neighbour
        Offset offset{};           ///< of the neighbour from the centre
    };
    [[nodiscard]] std::uint32_t valence() const { return valence_; }
    /// \pre n <= valence().
    [[nodiscard]] const Spoke& operator[](std::size_t n) const { return spokes_[first_ + n]; }
    /// How many spokes after the first the one at this corner is. \pre it is one.
    [[nodiscard]] std::uint32_t index_of(HalfEdge corner) const {
        std::uint32_t n = 0;
        while ((*this)[n].corner != corner) ++n;
        return n;
    }

    Offset centre{};

private:
    std::vector<Spoke> spokes_;  // twice, one after the other, so that a ring can begin anywhere; then room
    std::uint32_t valence_ = 0;
    std::uint32_t first_ = 0;
};

/// How a star lies: the axis its normal is nearest to, the plane through its centre, and how far it reaches.
struct StarFrame {
    unsigned across = 0;   ///< axis: 0, 1 or 2
    Offset normal{};       ///< of the plane, as long as twice the star's area
    Offset reach{};        ///< largest distance of a neighbour along each axis
    double thickness = 0;  ///< largest height of a neighbour over the plane, measured along `across`

    explicit StarFrame(const Star& star) {
        const std::uint32_t valence = star.valence();
        const Star::Spoke* const spokes = &star[0];
        for (std::uint32_t n = 0; n < valence; ++n) {
            const Offset& a = spokes[n].offset;
            const Offset& b = spokes[n + 1].offset;
            normal[0] += a[1] * b[2] - a[2] * b[1];
            normal[1] += a[2] * b[0] - a[0] * b[2];
            normal[2] += a[0] * b[1] - a[1] * b[0];
            for (int axis = 0; axis < 3; ++axis) reach[axis] = std::max(reach[axis], std::abs(a[axis]));
        }
        if (std::abs(normal[1]) > std::abs(normal[across])) across = 1;
        if (std::abs(normal[2]) > std::abs(normal[across])) across = 2;
        if (!has_plane()) return;
        for (std::uint32_t n = 0; n < valence; ++n) thickness = std::max(thickness, std::abs(dot(spokes[n].offset)));
        thickness /= std::abs(normal[across]);
    }
    [[nodiscard]] bool has_plane() const { return normal[across] != 0; }
    /// Over the plane, along `across`. \pre has_plane().
    [[nodiscard]] double height(const Offset& d) const { return dot(d) / normal[across]; }

private:
    [[nodiscard]] double dot(const Offset& d) const { return normal[0] * d[0] + normal[1] * d[1] + normal[2] * d[2]; }
};

}  // namespace vsplit
