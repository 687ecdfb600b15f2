#include "repair/segment_grid.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace vsplit {
namespace {

constexpr double kMostCells = 1e9;  // along an axis: their numbers fit an integer

}  // namespace

SegmentGrid::SegmentGrid(std::span<const Segment> segments, double reach) {
    BoundingBox box;
    double length = 0;
    for (const Segment& s : segments) {
        box.min = box.min.cwiseMin(s[0]).cwiseMin(s[1]);
        box.max = box.max.cwiseMax(s[0]).cwiseMax(s[1]);
        length += (s[1] - s[0]).norm();
    }
    low_ = box.min;
    width_ = std::max(
        {4 * reach, length / static_cast<double>(std::max<std::size_t>(1, segments.size())), box.diagonal() / kMostCells});
    const Vec3 pad = Vec3::Constant(width_ / 4 + reach);  // samples are half a cell apart
    std::vector<std::pair<Cell, std::uint32_t>> entries;
    for (std::uint32_t number = 0; number < segments.size(); ++number) {
        const auto& [from, to] = segments[number];
        const auto steps = static_cast<std::uint64_t>(std::ceil(2 * (to - from).norm() / width_));
        for (std::uint64_t step = 0; step <= steps; ++step) {
            const Vec3 sample =
                steps == 0 ? from : Vec3(from + (to - from) * (static_cast<double>(step) / static_cast<double>(steps)));
            const Cell least = cell_of(sample - pad);
            const Cell most = cell_of(sample + pad);
            for (std::int32_t x = least[0]; x <= most[0]; ++x) {
                for (std::int32_t y = least[1]; y <= most[1]; ++y) {
                    for (std::int32_t z = least[2]; z <= most[2]; ++z) entries.push_back({{x, y, z}, number});
                }
            }
        }
    }
    std::sort(entries.begin(), entries.end());
    entries.erase(std::unique(entries.begin(), entries.end()), entries.end());
    for (const auto& [cell, number] : entries) {
        if (cells_.empty() || cells_.back() != cell) {
            cells_.push_back(cell);
            first_.push_back(segments_.size());
        }
        segments_.push_back(number);
    }
    first_.push_back(segments_.size());
}

SegmentGrid::Cell SegmentGrid::cell_of(const Vec3& point) const {
    const Vec3 scaled = (point - low_) / width_;
    return {static_cast<std::int32_t>(std::floor(scaled.x())), static_cast<std::int32_t>(std::floor(scaled.y())),
            static_cast<std::int32_t>(std::floor(scaled.z()))};
}

std::span<const std::uint32_t> SegmentGrid::near(const Vec3& point) const {
    const auto found = std::lower_bound(cells_.begin(), cells_.end(), cell_of(point));
    if (found == cells_.end() || *found != cell_of(point)) return {};
    const auto at = static_cast<std::size_t>(found - cells_.begin());
    return std::span(segments_).subspan(first_[at], first_[at + 1] - first_[at]);
}

}  // namespace vsplit
