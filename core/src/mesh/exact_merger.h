#pragma once

#include <cstddef>
#include <cstdint>

#include "mesh/index_table.h"
#include "mesh/point_hash.h"
#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// Numbers points so that equal ones (-0 equals 0) have one number, in order of first appearance.
class ExactMerger {
public:
    /// Points handed over at a time: enough for the memory's latency to overlap.
    static constexpr std::size_t kBatch = 96;

    /// Makes room for `points` different points, so that it need not grow.
    void reserve(std::size_t points) { table_.reserve(points); }

    /// Numbers `points[0 .. count)` into `numbers`. `kept[n]` holds the point numbered n; those that are new are written behind
    /// the others, at kept[kept_count()] and on.
    /// \pre count <= kBatch; `kept` has room; it may be the array the points come from, as long as they lie behind what is kept.
    void merge(const Vec3* points, std::size_t count, Vec3* kept, std::uint32_t* numbers);

    [[nodiscard]] std::uint32_t kept_count() const { return kept_count_; }

private:
    PointHash hash_;
    IndexTable table_;
    std::uint32_t kept_count_ = 0;
};

}  // namespace vsplit
