#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "mrr/look_ahead.h"
#include "mrr/point_coder.h"
#include "mrr/star.h"
#include "mrr/symbols.h"
#include "vsplit/mrr/progressive_mesh.h"

namespace vsplit {

/// How the records of a block are coded; its first byte says so.
enum class BlockLayout : std::uint8_t {
    kFirst,
    kMeans  ///< points that are the mean of their ring say only that; two columns of places
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
        : symbols_(symbols), mesh_(mesh), layout_(layout), points_(symbols, codes, star_, layout == BlockLayout::kMeans) {}

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
        star_.gather(mesh_, vertex);
        if (!code_fan(split)) [[unlikely]]
            return bad("a fan that is none of the vertex");
        points_.code(split);
        if (!points_.in_range()) [[unlikely]]
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
        star_.gather(mesh_, move.vertex);
        points_.code(move);
        if (!points_.in_range()) return bad("a position that is not on the grid");
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

    /// With a bit more in a number, its high part means something else.
    [[nodiscard]] unsigned place_column(std::uint32_t count) const {
        return layout_ == BlockLayout::kMeans && std::bit_width(count - 1) % 2 != 0 ? column::kOddPlace : column::kPlace;
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

    void note_beside(std::uint32_t vertex, std::uint32_t added) {
        const std::uint32_t most = std::min(star_.valence(), kBeside - 2);
        beside_count_ = 2 + most;
        beside_[0] = vertex;
        beside_[1] = added;
        for (std::uint32_t n = 0; n < most; ++n) beside_[2 + n] = star_.vertices()[n];
    }

    Symbols symbols_;
    ProgressiveMesh& mesh_;
    const BlockLayout layout_;
    Star star_;
    PointCoder<Symbols, Codes> points_;
    Error error_{};
    std::array<std::uint32_t, kBeside> beside_{};
    std::uint32_t beside_count_ = 0;
    std::vector<std::uint32_t> places_;
    std::size_t next_ = 0;
    LookAhead look_ahead_{mesh_};
    std::uint32_t last_moved_ = kNone;  // so that the first move counts from vertex 0
};

}  // namespace vsplit
