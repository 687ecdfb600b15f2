#include "mesh/near_merger.h"

#include <algorithm>
#include <cmath>

namespace vsplit {

NearMerger::NearMerger(double tolerance, std::size_t points) : tolerance_(tolerance) { table_.reserve(points); }

double NearMerger::cell(double coordinate) const {
    constexpr double kExact = 4503599627370496;  // 2^52
    const double scaled = coordinate / tolerance_ / 3;
    // So far out that neighbouring doubles are further apart than the tolerance, every double is a cell of its own.
    return std::abs(scaled) < kExact ? std::floor(scaled) : coordinate;
}

std::uint32_t NearMerger::find_near(const Vec3& point, const std::vector<Vec3>& kept) const {
    const Vec3 low = cell(Vec3(point.array() - tolerance_));
    const Vec3 high = cell(Vec3(point.array() + tolerance_));
    std::uint32_t nearest = IndexTable::kNone;
    for (unsigned corner = 0; corner < 8; ++corner) {
        Vec3 at = low;
        bool repeated = false;
        for (int axis = 0; axis < 3; ++axis) {
            if (((corner >> axis) & 1U) == 0) continue;
            repeated = repeated || low[axis] == high[axis];
            at[axis] = high[axis];
        }
        if (repeated) continue;
        // Dividing first keeps tolerances apart whose squares are all zero.
        static_cast<void>(table_.find(hash_(at), [&](std::uint32_t index) {
            if (index < nearest && ((kept[index] - point) / tolerance_).squaredNorm() <= 1) nearest = index;
            return false;
        }));
    }
    return nearest;
}

std::uint32_t NearMerger::merge(const Vec3& point, std::uint32_t next, const std::vector<Vec3>& kept) {
    const std::uint32_t near = find_near(point, kept);
    if (near != IndexTable::kNone) return near;
    table_.insert(hash_(cell(point)), next);
    return next;
}

}  // namespace vsplit
