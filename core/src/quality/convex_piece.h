#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>

#include "spatial/shapes.h"

namespace vsplit {

/// A convex polygon in space, or a segment (two corners): a part of a face or crease.
class ConvexPiece {
public:
    static constexpr std::size_t kMaxCorners = 8;

    ConvexPiece() = default;
    explicit ConvexPiece(std::span<const Vec3> corners);

    [[nodiscard]] std::span<const Vec3> corners() const { return {corners_.data(), count_}; }
    [[nodiscard]] Vec3 centroid() const;
    /// Largest distance from `centre` to a point of the piece.
    [[nodiscard]] double radius(const Vec3& centre) const;

    /// Inside and outside of a half-space; nothing where no corner lies outside, or none inside, or the parts would have too many
    /// corners.
    [[nodiscard]] std::optional<std::pair<ConvexPiece, ConvexPiece>> cut(const HalfSpace& space) const;

    /// Two parts: halves across its longest extent where possible.
    [[nodiscard]] std::pair<ConvexPiece, ConvexPiece> halve() const;

private:
    void add(const Vec3& corner) { corners_[count_++] = corner; }
    [[nodiscard]] std::pair<ConvexPiece, ConvexPiece> cut_along_diagonal() const;

    std::array<Vec3, kMaxCorners> corners_;
    std::size_t count_ = 0;
};

}  // namespace vsplit
