#include "io/cut_polygon.h"

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

namespace vsplit {
namespace {

using Vec2 = Eigen::Vector2d;
using Corner = std::uint32_t;

constexpr std::uint64_t kTestsACorner = 2000;
constexpr double kFlat = 1e-15;  // of the square of the polygon's extent: an area that rounding makes
constexpr double kThin = 1e-9;   // of the square of a triangle's longest side: it would be a degenerate face

/// Twice the area of a, b, c: negative where they run clockwise.
double turn(const Vec2& a, const Vec2& b, const Vec2& c) {
    return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

double longest_squared(const Vec2& a, const Vec2& b, const Vec2& c) {
    return std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
}

/// The polygon seen along the axis that its normal is closest to, counter-clockwise, the first corner at the origin.
std::vector<Vec2> flattened(std::span<const Vec3> corners) {
    Vec3 normal = Vec3::Zero();  // Newell's
    for (std::size_t i = 2; i < corners.size(); ++i) {
        const Vec3 a = corners[i - 1] - corners[0];
        const Vec3 b = corners[i] - corners[0];
        normal += Vec3(a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(), a.x() * b.y() - a.y() * b.x());
    }
    Eigen::Index along = 0;
    normal.cwiseAbs().maxCoeff(&along);
    Eigen::Index x = (along + 1) % 3;
    Eigen::Index y = (along + 2) % 3;
    if (normal[along] < 0) std::swap(x, y);
    std::vector<Vec2> points;
    points.reserve(corners.size());
    for (const Vec3& corner : corners) points.emplace_back(corner[x] - corners[0][x], corner[y] - corners[0][y]);
    return points;
}

/// What rounding may make of no area.
double least_area(const std::vector<Vec2>& points) {
    double extent = 0;
    for (const Vec2& point : points) extent = std::max(extent, point.cwiseAbs().maxCoeff());
    return kFlat * extent * extent;
}

/// Cuts ears off a polygon: corners whose triangle with both neighbours holds no other corner. Meisters (1975).
class EarCutter {
public:
    EarCutter(const std::vector<Vec2>& points, double least_area)
        : points_(points), least_(least_area), next_(points.size()), prev_(points.size()), gone_(points.size(), false) {
        const auto n = static_cast<Corner>(points.size());
        for (Corner i = 0; i < n; ++i) {
            next_[i] = (i + 1) % n;
            prev_[i] = (i + n - 1) % n;
        }
        for (Corner i = 0; i < n; ++i) {
            if (area(i) <= thin(i)) blunt_.push_back(i);
        }
        std::sort(blunt_.begin(), blunt_.end(), [&](Corner l, Corner r) { return points_[l].x() < points_[r].x(); });
    }

    std::vector<Triangle> run() {
        std::size_t left = points_.size();
        Corner at = 0;
        std::size_t in_vain = 0;
        bool strict = true;
        while (left > 3) {
            if (tests_ > kTestsACorner * points_.size()) return {};
            if (in_vain == left) {
                if (!strict) break;  // it crosses itself
                strict = false;      // parts lie on a line, or it touches itself
                in_vain = 0;
            }
            if (!is_ear(at, strict)) {
                at = next_[at];
                ++in_vain;
                continue;
            }
            cut_off(at);
            --left;
            in_vain = 0;
            at = next_[next_[at]];  // not the one beside it: ears of one corner are slivers
        }
        const Corner first = gone_[at] ? next_[at] : at;
        for (Corner i = next_[first]; next_[i] != first; i = next_[i]) triangles_.push_back({first, i, next_[i]});
        return std::move(triangles_);
    }

private:
    [[nodiscard]] double area(Corner i) const { return turn(points_[prev_[i]], points_[i], points_[next_[i]]); }

    void cut_off(Corner i) {
        triangles_.push_back({prev_[i], i, next_[i]});
        next_[prev_[i]] = next_[i];
        prev_[next_[i]] = prev_[i];
        gone_[i] = true;
    }

    /// Up to this an area of the corner's triangle makes no face.
    [[nodiscard]] double thin(Corner i) const {
        return std::max(least_, kThin * longest_squared(points_[prev_[i]], points_[i], points_[next_[i]]));
    }

    /// `strict`: with an area, and no corner on its sides.
    [[nodiscard]] bool is_ear(Corner i, bool strict) {
        ++tests_;
        const double own = area(i);
        if (strict ? own <= thin(i) : own < -least_) return false;
        const Vec2& a = points_[prev_[i]];
        const Vec2& b = points_[i];
        const Vec2& c = points_[next_[i]];
        const double most = std::max({a.x(), b.x(), c.x()});
        const double inside = strict ? -thin(i) : least_;
        // Where any corner is inside, a blunt one is.
        auto other = std::lower_bound(blunt_.begin(), blunt_.end(), std::min({a.x(), b.x(), c.x()}),
                                      [&](Corner corner, double x) { return points_[corner].x() < x; });
        for (; other != blunt_.end() && points_[*other].x() <= most; ++other) {
            ++tests_;
            const Vec2& p = points_[*other];
            if (gone_[*other] || p == a || p == b || p == c) continue;
            if (turn(a, b, p) >= inside && turn(b, c, p) >= inside && turn(c, a, p) >= inside) return false;
        }
        return true;
    }

    const std::vector<Vec2>& points_;
    double least_;
    std::vector<Corner> next_;
    std::vector<Corner> prev_;
    std::vector<bool> gone_;
    std::vector<Corner> blunt_;  // corners of 180 degrees or more at the begin, by x
    std::vector<Triangle> triangles_;
    std::uint64_t tests_ = 0;
};

}  // namespace

std::vector<Triangle> cut_polygon(std::span<const Vec3> corners) {
    std::vector<Triangle> fan;
    for (Corner i = 2; i < corners.size(); ++i) fan.push_back({0, i - 1, i});
    if (fan.size() == 1) return fan;
    const std::vector<Vec2> points = flattened(corners);
    const double least = least_area(points);
    bool folds = false;
    bool has_flat = false;
    for (const auto& [i, j, k] : fan) {
        const double area = turn(points[i], points[j], points[k]);
        folds = folds || area < -least;
        has_flat = has_flat || area <= std::max(least, kThin * longest_squared(points[i], points[j], points[k]));
    }
    if (!folds && !has_flat) return fan;
    std::vector<Triangle> triangles = EarCutter(points, least).run();
    return triangles.empty() && !folds ? fan : triangles;
}

Status unfold_fan(const std::vector<Vec3>& positions, std::span<Triangle> fan, Place place) {
    if (fan.size() < 2) return Done{};
    std::vector<std::uint32_t> corners = {fan[0][0], fan[0][1]};
    for (const Triangle& face : fan) corners.push_back(face[2]);
    std::vector<Vec3> points;
    points.reserve(corners.size());
    for (const std::uint32_t corner : corners) points.push_back(positions[corner]);
    const std::vector<Triangle> triangles = cut_polygon(points);
    if (triangles.empty()) {
        return read_error(Cause::kLimitExceeded, place,
                          "a face of " + std::to_string(corners.size()) +
                              " corners is not convex and takes too long to cut; cut it into triangles first");
    }
    std::transform(triangles.begin(), triangles.end(), fan.begin(), [&](const Triangle& t) {
        return Triangle{corners[t[0]], corners[t[1]], corners[t[2]]};
    });
    return Done{};
}

}  // namespace vsplit
