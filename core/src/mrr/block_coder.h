#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "mrr/grid_codes.h"
#include "mrr/look_ahead.h"
#include "mrr/star.h"
#include "mrr/symbols.h"
#include "vsplit/mrr/progressive_mesh.h"

namespace vsplit {

/// How the records of a block are coded; its first byte says so.
enum class BlockLayout : std::uint8_t {
    kFirst,
    kMeans  ///< points that are the mean of their ring say only that; rings begin where a split most often cuts
};
inline constexpr BlockLayout kNewestLayout = BlockLayout::kMeans;

/// Codes one record after the other relative to the mesh it is applied to, and applies it. What is predicted depends on the mesh
/// as it stands and on the records of the block before; the mesh is the same whichever way it was reached.
///
/// `code`, writing, takes the record and rounds its positions; reading, it fills the record in. \return false, and error() says
/// why, where it does not fit: a Status for each would cost more than the record.
template <class Symbols, class Codes>
class BlockCoder {
public:
    BlockCoder(Symbols symbols, const Codes& codes, ProgressiveMesh& mesh, BlockLayout layout)
        : symbols_(symbols), codes_(codes), mesh_(mesh), knows_means_(layout == BlockLayout::kMeans) {}

    /// Reading only: takes the places of all splits of the block at once, so that the mesh around the next ones can be fetched
    /// from memory while one is decoded.
    void read_places(std::size_t splits) {
        places_.resize(splits);
        std::uint32_t count = mesh_.mesh().vertex_count();
        for (std::uint32_t& place : places_) place = read_place(count++);
        std::vector<std::uint32_t> far;
        std::copy_if(places_.begin(), places_.end(), std::back_inserter(far),
                     [](std::uint32_t place) { return place < kIsBeside; });
        look_ahead_.begin(LookAhead::By::kVertex, std::move(far));
    }

    /// Writing only: the splits that come, for the same reason.
    void foresee(std::span<const VertexSplit> splits) {
        std::vector<HalfEdge> anchors;
        anchors.reserve(splits.size());
        for (const VertexSplit& split : splits) anchors.push_back(split.anchor);
        look_ahead_.begin(LookAhead::By::kCorner, std::move(anchors));
    }

    [[nodiscard]] const Error& error() const { return error_; }

    [[nodiscard]] bool code(VertexSplit& split) {
        std::uint32_t vertex = 0;
        if constexpr (Symbols::kWrites) {
            look_ahead_.advance();
            vertex = origin(mesh_.mesh(), split.anchor);
            write_place(vertex);
        } else {
            vertex = next_place();
            if (vertex >= mesh_.mesh().vertex_count()) [[unlikely]]
                return bad("a vertex that is not there");
        }
        star_.gather(mesh_, vertex, ring_begin());
        if (!code_fan(split)) [[unlikely]]
            return bad("a fan that is none of the vertex");
        code_positions(split);
        if (!in_range_) [[unlikely]]
            return bad("a position that is not on the grid");
        const std::uint32_t added = mesh_.mesh().vertex_count();
        if (!taken(mesh_.refine(split, star_.corners()))) return false;
        note_beside(vertex, added);
        last_moved_ = kNone;
        return true;
    }

    [[nodiscard]] bool code(EdgeFlip& flip) {
        code_uniform(symbols_, column::kFlip, flip.half_edge, static_cast<std::uint32_t>(mesh_.twins().size()));
        if (!taken(mesh_.refine(flip))) return false;
        const HalfEdge twin = mesh_.twins()[flip.half_edge];
        beside_count_ = 0;
        for (const HalfEdge corner : {flip.half_edge, prev(flip.half_edge), twin, prev(twin)})
            beside_[beside_count_++] = origin(mesh_.mesh(), corner);
        last_moved_ = kNone;
        return true;
    }

    [[nodiscard]] bool code(VertexMove& move) {
        std::uint32_t step = to_zigzag(static_cast<std::int32_t>(move.vertex - last_moved_ - 1));  // ascending: 0
        symbols_.number(column::kMoved, step);
        move.vertex = last_moved_ + 1 + static_cast<std::uint32_t>(from_zigzag(step));
        if (move.vertex >= mesh_.mesh().vertex_count()) return bad("a vertex that is not there");
        last_moved_ = move.vertex;
        star_.gather(mesh_, move.vertex, ring_begin());
        const StarFrame frame(star_);
        code_point(frame, columns(frame, column::kMoveAlong, column::kMoveAcross), {}, move.position);
        if (!in_range_) return bad("a position that is not on the grid");
        return taken(mesh_.refine(move));
    }

private:
    static constexpr std::uint32_t kBeside = 128;  // symbols from here on name a vertex beside the record before
    static constexpr std::uint32_t kMostCodedFan = 10;
    static constexpr std::uint32_t kIsBeside = 0xFFFFFF00U;

    bool bad(const char* what) {
        error_ = {Cause::kCorrupt, what, ""};
        return false;
    }
    bool taken(const Status& status) {
        if (status) [[likely]]
            return true;
        error_ = status.error();
        return false;
    }

    [[nodiscard]] RingBegin ring_begin() const { return knows_means_ ? RingBegin::kNarrowest : RingBegin::kNearest; }

    /// With a bit more in a number, its high part means something else.
    [[nodiscard]] unsigned place_column(std::uint32_t count) const {
        return knows_means_ && std::bit_width(count - 1) % 2 != 0 ? column::kOddPlace : column::kPlace;
    }

    void write_place(std::uint32_t vertex) {
        const unsigned low = low_bits(mesh_.mesh().vertex_count());
        const auto* const end = beside_.data() + beside_count_;
        const auto* const found = std::find<const std::uint32_t*>(beside_.data(), end, vertex);
        std::uint32_t symbol = found != end ? kBeside + static_cast<std::uint32_t>(found - beside_.data()) : vertex >> low;
        symbols_.byte(place_column(mesh_.mesh().vertex_count()), symbol);
        std::uint32_t rest = vertex & ((1U << low) - 1);
        if (symbol < kBeside) symbols_.bits(column::kPlaceBits, rest, low);
    }

    /// A vertex, or kIsBeside + its place in the list of those beside the record before.
    std::uint32_t read_place(std::uint32_t count) {
        std::uint32_t symbol = 0, rest = 0;
        symbols_.byte(place_column(count), symbol);
        if (symbol >= kBeside) return kIsBeside + (symbol - kBeside);
        const unsigned low = low_bits(count);
        symbols_.bits(column::kPlaceBits, rest, low);
        return symbol << low | rest;
    }

    /// kNone where there is no such vertex.
    std::uint32_t next_place() {
        const std::uint32_t place = places_[next_++];
        if (place < kIsBeside) {
            look_ahead_.advance();
            return place;
        }
        return place - kIsBeside < beside_count_ ? beside_[place - kIsBeside] : kNone;
    }

    /// Where the fan that goes over begins and how many faces it has; leaves the star turned to its beginning.
    bool code_fan(VertexSplit& split) {
        const std::uint32_t valence = star_.valence();
        std::uint32_t turn = Symbols::kWrites ? star_.index_of(split.anchor) : 0;
        std::uint32_t more = split.steps - 1;
        if (valence >= 3 && valence <= kMostCodedFan) {
            std::uint32_t symbol = turn * (valence - 1) + more;
            symbols_.byte(column::kFan + valence, symbol);
            turn = symbol / (valence - 1);
            more = symbol % (valence - 1);
        } else {
            symbols_.number(column::kLargeFan, turn);
            symbols_.number(column::kLargeFan, more);
        }
        if (turn >= valence || more + 1 >= valence) return false;
        star_.turn(turn);
        split.anchor = star_.corners()[0];
        split.steps = more + 1;
        return true;
    }

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

    /// Near the middle of the fan that goes over lies the new vertex, near that of the rest the old one. One that an earlier step
    /// of the method made lies at the mean of its ring, unless something in that has changed since: this needs no guess.
    void code_positions(VertexSplit& split) {
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

    void note_beside(std::uint32_t vertex, std::uint32_t added) {
        const std::uint32_t most = std::min(star_.valence(), kBeside - 2);
        beside_count_ = 2 + most;
        beside_[0] = vertex;
        beside_[1] = added;
        for (std::uint32_t n = 0; n < most; ++n) beside_[2 + n] = star_.vertices()[n];
    }

    Symbols symbols_;
    const Codes codes_;
    ProgressiveMesh& mesh_;
    const bool knows_means_;
    Star star_;
    Error error_{};
    std::array<std::uint32_t, kBeside> beside_{};
    std::uint32_t beside_count_ = 0;
    std::vector<std::uint32_t> places_;
    std::size_t next_ = 0;
    LookAhead look_ahead_{mesh_};
    std::uint32_t last_moved_ = kNone;  // so that the first move counts from vertex 0
    bool in_range_ = true;
};

}  // namespace vsplit
