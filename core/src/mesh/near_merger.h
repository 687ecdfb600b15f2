#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/index_table.h"
#include "mesh/point_hash.h"
#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// Numbers points so that one within a distance of a kept one takes its number; of several, the one kept first.
///
/// Kept points lie in a grid of cells three times as wide as the tolerance, so that a point's neighbourhood touches at most
/// eight, however its bounds are rounded. Kept points are more than the tolerance apart, so a cell holds few of them, whatever
/// the tolerance.
class NearMerger {
public:
    /// \pre 0 < tolerance < infinity. `points` in all will come at most.
    NearMerger(double tolerance, std::size_t points);

    /// The number of `point`; when it is new, that is `next`, and `kept[next]` must be set to it before the next call.
    [[nodiscard]] std::uint32_t merge(const Vec3& point, std::uint32_t next, const std::vector<Vec3>& kept);

private:
    [[nodiscard]] double cell(double coordinate) const;
    [[nodiscard]] Vec3 cell(const Vec3& point) const { return {cell(point.x()), cell(point.y()), cell(point.z())}; }
    [[nodiscard]] std::uint32_t find_near(const Vec3& point, const std::vector<Vec3>& kept) const;

    double tolerance_;
    PointHash hash_;
    IndexTable table_;
};

}  // namespace vsplit
