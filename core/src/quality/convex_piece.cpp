#include "quality/convex_piece.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace vsplit {

ConvexPiece::ConvexPiece(std::span<const Vec3> corners) : count_(corners.size()) {
    assert(corners.size() <= kMaxCorners);
    std::copy(corners.begin(), corners.end(), corners_.begin());
}

Vec3 ConvexPiece::centroid() const {
    Vec3 sum = Vec3::Zero();
    for (const Vec3& p : corners()) sum += p;
    return sum / static_cast<double>(count_);
}

double ConvexPiece::radius(const Vec3& centre) const {
    double squared = 0;
    for (const Vec3& p : corners()) squared = std::max(squared, (p - centre).squaredNorm());
    return std::sqrt(squared);
}

std::optional<std::pair<ConvexPiece, ConvexPiece>> ConvexPiece::cut(const HalfSpace& space) const {
    if (count_ == kMaxCorners) return std::nullopt;
    std::array<double, kMaxCorners> excess{};
    for (std::size_t i = 0; i < count_; ++i) excess[i] = space.excess(corners_[i]);
    const auto end = excess.begin() + static_cast<std::ptrdiff_t>(count_);
    const auto [least, most] = std::minmax_element(excess.begin(), end);
    if (!(*least < 0 && *most > 0)) return std::nullopt;

    std::pair<ConvexPiece, ConvexPiece> sides;
    int crossings = 0;
    const std::size_t edges = count_ == 2 ? 1 : count_;
    for (std::size_t i = 0; i < count_; ++i) {
        if (excess[i] <= 0) sides.first.add(corners_[i]);
        if (excess[i] >= 0) sides.second.add(corners_[i]);
        const std::size_t next = i + 1 == count_ ? 0 : i + 1;
        const bool crossed = std::min(excess[i], excess[next]) < 0 && std::max(excess[i], excess[next]) > 0;
        if (i >= edges || !crossed) continue;
        if (++crossings > 2) return std::nullopt;  // as thin as rounding, it seems to be entered twice
        const Vec3 between = corners_[i] + (corners_[next] - corners_[i]) * (excess[i] / (excess[i] - excess[next]));
        sides.first.add(between);
        sides.second.add(between);
    }
    return sides;
}

std::pair<ConvexPiece, ConvexPiece> ConvexPiece::cut_along_diagonal() const {
    const std::size_t half = count_ / 2;
    std::pair<ConvexPiece, ConvexPiece> parts;
    for (std::size_t i = 0; i <= half; ++i) parts.first.add(corners_[i]);
    for (std::size_t i = half; i < count_; ++i) parts.second.add(corners_[i]);
    parts.second.add(corners_[0]);
    return parts;
}

std::pair<ConvexPiece, ConvexPiece> ConvexPiece::halve() const {
    std::pair<Vec3, Vec3> ends{corners_[0], corners_[0]};
    double longest = 0;
    for (std::size_t i = 0; i < count_; ++i) {
        for (std::size_t j = i + 1; j < count_; ++j) {
            const double squared = (corners_[i] - corners_[j]).squaredNorm();
            if (squared <= longest) continue;
            longest = squared;
            ends = {corners_[i], corners_[j]};
        }
    }
    const Vec3 normal = ends.second - ends.first;
    if (const auto halves = cut({normal, normal.dot((ends.first + ends.second) / 2)})) return *halves;
    if (count_ > 3) return cut_along_diagonal();
    return {*this, *this};  // so small that there is nothing between its corners
}

}  // namespace vsplit
