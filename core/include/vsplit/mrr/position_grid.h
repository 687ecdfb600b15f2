#pragma once

#include <cstdint>

#include "vsplit/base/expected.h"
#include "vsplit/mrr/multires_mesh.h"

namespace vsplit {

/// How the records of a block are laid out as bytes, and with that which positions they can hold (docs/format.md).
enum class RecordEncoding : std::uint32_t {
    kFloat64 = 1,    ///< bit-exact columns, uncompressed: 57 bytes a split, 5 a flip, 29 a move; needs no mesh to decode
    kFloat32 = 2,    ///< every coordinate rounded to float32; predicted, compressed
    kQuantised = 3,  ///< every coordinate on a grid over the bounding box; predicted, compressed
};

/// An encoding as a client asks for it.
struct EncodingChoice {
    RecordEncoding encoding = RecordEncoding::kFloat64;
    std::uint32_t bits = 0;  ///< kQuantised: 10 .. 24 a coordinate; 0 means 14. Otherwise 0.

    friend bool operator==(const EncodingChoice&, const EncodingChoice&) = default;
};

inline constexpr std::uint32_t kFewestBits = 10;
inline constexpr std::uint32_t kMostBits = 24;
inline constexpr std::uint32_t kUsualBits = 14;

/// With the default filled in. \return INVALID_OPTION (field "encoding" or "quantisation_bits") for bits out of range.
[[nodiscard]] Expected<EncodingChoice> check_encoding(EncodingChoice choice);

/// The positions an encoding can hold. Each coordinate is rounded by itself, and the same whichever record or base mesh brings
/// it: so any level of an MRR is that level rounded, bit for bit, whichever way it was reached.
class PositionGrid {
public:
    /// Every double.
    PositionGrid() = default;

    /// Every float.
    [[nodiscard]] static PositionGrid float32();

    /// origin + n * step, n from 0 to 2^bits - 1. \return INVALID_OPTION for bits out of range, a step under 2^-1022 or a
    /// grid that reaches beyond 1e15.
    [[nodiscard]] static Expected<PositionGrid> quantised(std::uint32_t bits, const Vec3& origin, double step);

    /// The grid of an encoding over all positions of `mrr`, at every level. Quantised: the step is the longest side of their
    /// bounding box divided by 2^bits - 1, the same on all axes. O(records). \return as check_encoding.
    [[nodiscard]] static Expected<PositionGrid> over(const MultiresMesh& mrr, const EncodingChoice& choice);

    /// The same for who knows box_of_all(mrr). O(1).
    [[nodiscard]] static Expected<PositionGrid> over(const BoundingBox& box, const EncodingChoice& choice);

    [[nodiscard]] RecordEncoding encoding() const { return encoding_; }
    [[nodiscard]] std::uint32_t bits() const { return bits_; }    ///< 0 unless quantised
    [[nodiscard]] const Vec3& origin() const { return origin_; }  ///< 0 unless quantised
    [[nodiscard]] double step() const { return step_; }           ///< 0 unless quantised

    /// No coordinate of a mesh that fits the box is rounded by more than this, model units; `largest` is the largest absolute
    /// value of a coordinate. 0 for every double.
    [[nodiscard]] double max_error(double largest) const;

    /// The point of the grid that is nearest, coordinate by coordinate. \pre position is valid; quantised: in the box.
    [[nodiscard]] Vec3 snap(const Vec3& position) const;

    friend bool operator==(const PositionGrid&, const PositionGrid&) = default;

private:
    RecordEncoding encoding_ = RecordEncoding::kFloat64;
    std::uint32_t bits_ = 0;
    Vec3 origin_ = Vec3::Zero();
    double step_ = 0;
};

/// Records with every position snapped. O(records).
[[nodiscard]] RecordList on_grid(const RecordSpan& records, const PositionGrid& grid);

/// `mrr` with every position snapped: what a client of this encoding builds. O(records).
[[nodiscard]] MultiresMesh on_grid(const MultiresMesh& mrr, const PositionGrid& grid);

/// Calls visit(position) for the base's positions and those of all records.
template <class Visit>
void for_each_position(const MultiresMesh& mrr, Visit visit) {
    for (const Vec3& position : mrr.base.positions) visit(position);
    for (const VertexSplit& split : mrr.records.splits()) {
        visit(split.kept);
        visit(split.added);
    }
    for (const VertexMove& move : mrr.records.moves()) visit(move.position);
}

/// The box around all of those. O(records).
[[nodiscard]] BoundingBox box_of_all(const MultiresMesh& mrr);

}  // namespace vsplit
