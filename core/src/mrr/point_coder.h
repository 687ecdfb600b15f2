#pragma once

#include <array>
#include <cstdint>

#include "mrr/columns.h"
#include "mrr/star.h"
#include "mrr/symbols.h"
#include "vsplit/mrr/records.h"

namespace vsplit {

/// Codes the positions of records relative to the ring of the vertex they are about.
template <class Symbols, class Codes>
class PointCoder {
public:
    /// `star` holds that ring at each call and outlives this.
    PointCoder(Symbols symbols, const Codes& codes, const Star& star, bool knows_means)
        : symbols_(symbols), codes_(codes), star_(star), knows_means_(knows_means) {}

    /// Whether all coordinates so far were on the grid.
    [[nodiscard]] bool in_range() const { return in_range_; }

    /// Near the middle of the fan that goes over lies the new vertex, near that of the rest the old one. One that an earlier step
    /// of the method made lies at the mean of its ring, unless something in that has changed since: this needs no guess.
    void code(VertexSplit& split) {
        const StarFrame frame(star_);
        const Columns to = columns(frame, column::kAlong, column::kAcross);
        const Sides sides = find_sides(frame, split.steps);
        const Guess guess = guess_added(sides);
        std::uint32_t off = 0;
        Mean mean = Mean::kNeither;
        if constexpr (Symbols::kWrites) mean = find_mean(sides, split, off);
        const bool added_is_mean = knows_means_ && symbols_.mean(to.u, mean == Mean::kAdded);
        if (!added_is_mean) code_point(frame, to, guess, split.added);
        if (!added_is_mean && knows_means_ && symbols_.mean(to.u, mean == Mean::kKept)) {
            code_mean(mean_with(sides.rest, sides.in_rest, split.added), off, split.kept);
            return;
        }
        const Offset added = added_is_mean ? guess.offset : from_centre(split.added);
        const double height = added_is_mean ? guess.height : frame.has_plane() ? frame.height(added) : 0;
        code_point(frame, to, guess_kept(sides, added, height), split.kept);
        if (added_is_mean) code_mean(mean_with(sides.fan, sides.in_fan, split.kept), off, split.added);
    }

    void code(VertexMove& move) {
        const StarFrame frame(star_);
        code_point(frame, columns(frame, column::kMoveAlong, column::kMoveAcross), {}, move.position);
    }

private:
    /// Where the coordinates of a point go: along the two axes of the plane, and across it.
    struct Columns {
        unsigned u = 0, v = 0, w = 0;
    };

    /// Where a point is expected: `offset` from the centre, `height` over the plane.
    struct Guess {
        Offset offset{};
        double height = 0;
    };

    /// What the positions of a split are coded by: the fan that goes over with its two ends, and the rest with them.
    struct Sides {
        std::uint32_t in_fan, in_rest;  ///< how many neighbours
        Offset fan, rest, ends;         ///< their means
        double fan_height, rest_height, ends_height;
    };

    Sides find_sides(const StarFrame& frame, std::uint32_t steps) const {
        const std::uint32_t valence = star_.valence();
        Sides sides{steps + 1, valence - steps + 1, mean_offset(0, steps), mean_offset(steps, valence), {}, 0, 0, 0};
        for (int axis = 0; axis < 3; ++axis) sides.ends[axis] = (star_.offsets()[0][axis] + star_.offsets()[steps][axis]) * 0.5;
        if (!frame.has_plane()) return sides;
        sides.fan_height = frame.height(sides.fan);
        sides.rest_height = frame.height(sides.rest);
        sides.ends_height = frame.height(sides.ends);
        return sides;
    }

    // The weights were fitted to meshes of all kinds and are part of the format.
    static Guess guess_added(const Sides& of) {
        Guess guess{{}, (0.35 * of.fan_height - 0.15 * of.rest_height) + 0.1 * of.ends_height};
        for (int axis = 0; axis < 3; ++axis)
            guess.offset[axis] = (0.5 * of.fan[axis] - 0.2 * of.rest[axis]) + 0.15 * of.ends[axis];
        return guess;
    }
    static Guess guess_kept(const Sides& of, const Offset& added, double added_height) {
        Guess guess{{}, ((0.5 * of.rest_height - 0.35 * of.fan_height) + 0.05 * of.ends_height) + 0.4 * added_height};
        for (int axis = 0; axis < 3; ++axis)
            guess.offset[axis] = ((0.55 * of.rest[axis] - 0.4 * of.fan[axis]) + 0.1 * of.ends[axis]) + 0.4 * added[axis];
        return guess;
    }

    /// Which of the two points of a split is the mean of its ring, the other one included.
    enum class Mean : std::uint8_t { kNeither, kAdded, kKept };

    /// Writing only. `off` becomes what code_mean codes.
    Mean find_mean(const Sides& sides, const VertexSplit& split, std::uint32_t& off) const {
        const Vec3 kept = snapped(split.kept), added = snapped(split.added);
        if (is_mean(mean_with(sides.rest, sides.in_rest, added), kept, off)) return Mean::kKept;
        return is_mean(mean_with(sides.fan, sides.in_fan, kept), added, off) ? Mean::kAdded : Mean::kNeither;
    }

    /// At most one number away along each axis, for the ring is rounded, too.
    bool is_mean(const Offset& mean, const Vec3& point, std::uint32_t& off) const {
        off = 0;
        for (unsigned axis = 0; axis < 3; ++axis) {
            const std::uint32_t by = codes_.code(point[axis], axis) + 1 - codes_.code(star_.centre[axis] + mean[axis], axis);
            if (by > 2) return false;
            off = 3 * off + by;
        }
        return true;
    }

    void code_mean(const Offset& mean, std::uint32_t off, Vec3& point) {
        symbols_.byte(column::kMean, off);
        in_range_ = in_range_ && off < 27;
        const std::array<std::uint32_t, 3> by{off / 9, off / 3 % 3, off % 3};
        for (unsigned axis = 0; axis < 3; ++axis) {
            const std::uint32_t code = codes_.code(star_.centre[axis] + mean[axis], axis) + by[axis] - 1;
            in_range_ = in_range_ && codes_.holds(code);
            point[axis] = codes_.value(code, axis);
        }
    }

    /// Of `count` neighbours with this mean and one more.
    Offset mean_with(const Offset& mean, std::uint32_t count, const Vec3& one) const {
        const Offset d = from_centre(one);
        Offset all{};
        for (int axis = 0; axis < 3; ++axis) all[axis] = (mean[axis] * count + d[axis]) / (count + 1.0);
        return all;
    }

    Offset from_centre(const Vec3& point) const {
        return {point[0] - star_.centre[0], point[1] - star_.centre[1], point[2] - star_.centre[2]};
    }
    Vec3 snapped(const Vec3& point) const {
        Vec3 result;
        for (unsigned axis = 0; axis < 3; ++axis) result[axis] = codes_.value(codes_.code(point[axis], axis), axis);
        return result;
    }

    /// Of the neighbours from `first` to `last`, both included.
    Offset mean_offset(std::uint32_t first, std::uint32_t last) const {
        const Offset* const offsets = star_.offsets();
        double x = 0, y = 0, z = 0;
        for (std::uint32_t n = first; n <= last; ++n) {
            x += offsets[n][0];
            y += offsets[n][1];
            z += offsets[n][2];
        }
        const double count = last - first + 1;
        return {x / count, y / count, z / count};
    }

    Columns columns(const StarFrame& frame, unsigned along, unsigned across) const {
        const auto along_axis = [&](unsigned axis) { return along + codes_.scale(frame.reach[axis], star_.centre[axis]); };
        const unsigned w = frame.across;
        return {along_axis((w + 1) % 3), along_axis((w + 2) % 3),
                frame.has_plane() ? across + codes_.scale(frame.thickness, star_.centre[w]) : along_axis(w)};
    }

    /// The two coordinates along the plane come first, and with them the plane says where to expect the third.
    void code_point(const StarFrame& frame, const Columns& to, const Guess& guess, Vec3& point) {
        const Offset& centre = star_.centre;
        const unsigned u = (frame.across + 1) % 3, v = (frame.across + 2) % 3, w = frame.across;
        put(to.u, centre[u] + guess.offset[u], u, point);
        put(to.v, centre[v] + guess.offset[v], v, point);
        if (!frame.has_plane()) {
            put(to.w, centre[w] + guess.offset[w], w, point);
            return;
        }
        const double slope =
            (frame.normal[u] * (point[u] - centre[u]) + frame.normal[v] * (point[v] - centre[v])) / frame.normal[w];
        put(to.w, (centre[w] - slope) + guess.height, w, point);
    }

    void put(unsigned column, double expected, unsigned axis, Vec3& point) {
        if (in_range_) in_range_ = code_coordinate(symbols_, codes_, column, expected, axis, point[axis]);
    }

    Symbols symbols_;
    const Codes codes_;
    const Star& star_;
    const bool knows_means_;
    bool in_range_ = true;
};

}  // namespace vsplit
