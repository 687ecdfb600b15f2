#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "mesh/corners.h"
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
        const Vec3* const positions = mesh.mesh().positions.data();
        const std::uint32_t* const vertex_at = corners_of(mesh.mesh().faces);
        const HalfEdge* const twins = mesh.twins().data();
        for (int axis = 0; axis < 3; ++axis) centre[axis] = positions[vertex][axis];
        const HalfEdge start = mesh.corner_of(vertex);
        HalfEdge corner = start;
        std::uint64_t least = std::numeric_limits<std::uint64_t>::max();
        std::uint32_t nearest = kNone;  // vertex
        std::uint32_t n = 0, first = 0;
        do {
            if (2 * n + 2 + kCopied > corners_.size()) [[unlikely]]
                grow();
            const std::uint32_t neighbour = vertex_at[next(corner)];
            corners_[n] = corner;
            vertices_[n] = neighbour;
            Offset& d = offsets_[n];
            for (int axis = 0; axis < 3; ++axis) d[axis] = positions[neighbour][axis] - centre[axis];
            // Doubles that are not negative are in the order of their bits. Nobody can foresee which is the nearest, so this is
            // selected, not branched to: by masks, for g++ makes a choice a branch again.
            const auto square = std::bit_cast<std::uint64_t>(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
            const bool nearer = (square < least) | ((square == least) & (neighbour < nearest));
            const std::uint64_t mask = 0 - std::uint64_t{nearer};
            first ^= (first ^ n) & static_cast<std::uint32_t>(mask);
            nearest ^= (nearest ^ neighbour) & static_cast<std::uint32_t>(mask);
            least ^= (least ^ square) & mask;
            ++n;
            corner = twins[prev(corner)];
        } while (corner != start);
        valence_ = n;
        first_ = first;
        for (std::uint32_t from = 0; from < n; from += kCopied) repeat(from);
    }

    /// Begins the ring `steps` later. \pre steps < valence().
    void turn(std::uint32_t steps) {
        first_ += steps;
        if (first_ >= valence_) first_ -= valence_;
    }

    [[nodiscard]] std::uint32_t valence() const { return valence_; }
    /// From the first neighbour on, once around and back to it: valence() + 1 of them can be read. Each neighbour's offset from
    /// the centre, its number, and the corner of the centre in the face after it.
    [[nodiscard]] const Offset* offsets() const { return offsets_.data() + first_; }
    [[nodiscard]] const std::uint32_t* vertices() const { return vertices_.data() + first_; }
    [[nodiscard]] const HalfEdge* corners() const { return corners_.data() + first_; }
    /// How many neighbours after the first the one at this corner is. \pre it is one.
    [[nodiscard]] std::uint32_t index_of(HalfEdge corner) const {
        return static_cast<std::uint32_t>(std::find(corners(), corners() + valence_, corner) - corners());
    }

    Offset centre{};

private:
    static constexpr std::uint32_t kCopied = 8;  // at once: as many as most rings have, so that no loop is needed for them

    /// The second time around, as far as kCopied neighbours from `from` on go; beyond the ring there is room. Number by number: a
    /// processor hands on what was just written to who reads as much of it, and lets who reads more wait.
    void repeat(std::uint32_t from) {
        for (std::uint32_t n = from; n < from + kCopied; ++n) {
            for (int axis = 0; axis < 3; ++axis) offsets_[valence_ + n][axis] = offsets_[n][axis];
            corners_[valence_ + n] = corners_[n];
            vertices_[valence_ + n] = vertices_[n];
        }
    }
    void grow() {
        const std::size_t size = 2 * (corners_.size() + 2 * std::size_t{kCopied});
        offsets_.resize(size);
        corners_.resize(size);
        vertices_.resize(size);
    }

    // The ring twice, one after the other, so that it can begin anywhere; then room for kCopied.
    std::vector<Offset> offsets_;
    std::vector<HalfEdge> corners_;
    std::vector<std::uint32_t> vertices_;
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
        const Offset* const offsets = star.offsets();
        double nx = 0, ny = 0, nz = 0, rx = 0, ry = 0, rz = 0;
        double ax = offsets[0][0], ay = offsets[0][1], az = offsets[0][2];
        for (std::uint32_t n = 1; n <= valence; ++n) {
            const double bx = offsets[n][0], by = offsets[n][1], bz = offsets[n][2];
            nx += ay * bz - az * by;
            ny += az * bx - ax * bz;
            nz += ax * by - ay * bx;
            rx = std::max(rx, std::abs(ax));
            ry = std::max(ry, std::abs(ay));
            rz = std::max(rz, std::abs(az));
            ax = bx, ay = by, az = bz;
        }
        normal = {nx, ny, nz};
        reach = {rx, ry, rz};
        if (std::abs(normal[1]) > std::abs(normal[across])) across = 1;
        if (std::abs(normal[2]) > std::abs(normal[across])) across = 2;
        if (!has_plane()) return;
        for (std::uint32_t n = 0; n < valence; ++n) thickness = std::max(thickness, std::abs(dot(offsets[n])));
        thickness /= std::abs(normal[across]);
    }
    [[nodiscard]] bool has_plane() const { return normal[across] != 0; }
    /// Over the plane, along `across`. \pre has_plane().
    [[nodiscard]] double height(const Offset& d) const { return dot(d) / normal[across]; }

private:
    [[nodiscard]] double dot(const Offset& d) const { return normal[0] * d[0] + normal[1] * d[1] + normal[2] * d[2]; }
};

}  // namespace vsplit
