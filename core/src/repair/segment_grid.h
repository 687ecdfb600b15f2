#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// Segments in cells of space: which may lie within a distance of a point.
class SegmentGrid {
public:
    using Segment = std::array<Vec3, 2>;

    /// \pre reach > 0; finite coordinates. O(n log n) for segments of like length; the cells are as wide as the mean, or the
    /// reach.
    SegmentGrid(std::span<const Segment> segments, double reach);

    /// Numbers of segments, ascending, among them all that are no further from `point` than the reach. O(log n + result).
    [[nodiscard]] std::span<const std::uint32_t> near(const Vec3& point) const;

private:
    using Cell = std::array<std::int32_t, 3>;

    [[nodiscard]] Cell cell_of(const Vec3& point) const;

    Vec3 low_;
    double width_ = 1;
    std::vector<Cell> cells_;         // ascending, each once
    std::vector<std::size_t> first_;  // of each cell in segments_, and one behind
    std::vector<std::uint32_t> segments_;
};

}  // namespace vsplit
