#include "spatial/shapes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

namespace vsplit {
namespace {

/// Squared ratio of twice the area to the square of the longest edge under which the weights of the corners are too rough to
/// decide by their signs alone.
constexpr double kThin = 1e-8;

/// Projections nearer to an edge than this share of the height are taken to the edge, where corners are exact.
constexpr double kBorder = 1e-12;

/// An end is given exactly, so that all shapes that meet at it are equally far from a point nearest to it.
Footpoint closest_on_segment(const Vec3& a, const Vec3& b, const Vec3& p) {
    const Vec3 ab = b - a;
    const double along = ab.dot(p - a);
    const double whole = ab.squaredNorm();
    const Vec3 q = along <= 0 || whole <= 0 ? a : (along >= whole ? b : Vec3(a + ab * (along / whole)));
    return {(p - q).squaredNorm(), q};
}

void keep_nearer(Footpoint& best, const Footpoint& other) {
    if (other.squared_distance < best.squared_distance) best = other;
}

HalfSpace half_space(const Vec3& outward, const Vec3& through) {
    const double length = outward.norm();
    if (!(length > 0)) return {};
    const Vec3 normal = outward / length;
    return {normal, normal.dot(through)};
}

}  // namespace

Footpoint SegmentShape::closest(const Vec3& p) const { return closest_on_segment(corners[0], corners[1], p); }

std::array<HalfSpace, 2> SegmentShape::sides() const {
    const Vec3 along = corners[1] - corners[0];
    return {half_space(-along, corners[0]), half_space(along, corners[1])};
}

PreparedTriangle::PreparedTriangle(const TriangleShape& shape) : shape_(shape) {
    const auto& [a, b, c] = shape.corners;
    const Vec3 normal = (b - a).cross(c - a);
    whole_ = normal.squaredNorm();
    rise_b_ = (c - a).cross(normal);
    rise_c_ = normal.cross(b - a);
    const double ab = (b - a).squaredNorm(), ac = (c - a).squaredNorm(), bc = (c - b).squaredNorm();
    const double longest = std::max({ab, ac, bc});
    thin_ = !(whole_ > kThin * longest * longest);
    far_ = {whole_ * bc, whole_ * ac, whole_ * ab};
}

PreparedTriangle::Weights PreparedTriangle::weights(const Vec3& p) const {
    const Vec3 ap = p - shape_.corners[0];
    const double weight_b = rise_b_.dot(ap);
    const double weight_c = rise_c_.dot(ap);
    return {whole_ - weight_b - weight_c, weight_b, weight_c};
}

Footpoint PreparedTriangle::closest(const Vec3& p, const Weights& weight) const {
    const auto& [a, b, c] = shape_.corners;
    const double border = kBorder * whole_;  // weights up to this are taken for none
    const bool inside = weight.a > border && weight.b > border && weight.c > border;
    Footpoint best{(p - a).squaredNorm(), a};
    if (inside) {
        const Vec3 q = a + (b - a) * (weight.b / whole_) + (c - a) * (weight.c / whole_);
        if (!thin_) return {(p - q).squaredNorm(), q};
        keep_nearer(best, {(p - q).squaredNorm(), q});
    }
    // From outside, the nearest point is on an edge whose line separates p's projection from the triangle.
    if (thin_ || weight.c <= border) keep_nearer(best, closest_on_segment(a, b, p));
    if (thin_ || weight.b <= border) keep_nearer(best, closest_on_segment(a, c, p));
    if (thin_ || weight.a <= border) keep_nearer(best, closest_on_segment(b, c, p));
    return best;
}

bool PreparedTriangle::is_beyond(const Vec3& p, const Weights& weight, double most) const {
    constexpr double kFactor = 1.001;
    constexpr double kRounding = 1e-12;    // of weights, as the square of a share of the distance to a corner: really 1e-23
    constexpr double kCoordinate = 1e-26;  // of points, as that of their coordinates: really 1e-31
    if (thin_) return false;
    const double rounding = kRounding * (p - shape_.corners[0]).squaredNorm() + kCoordinate * p.squaredNorm();
    const double sure = kFactor * (most + rounding);
    const auto beyond = [sure](double w, double far) { return w < 0 && w * w > sure * far; };
    return beyond(weight.a, far_[0]) || beyond(weight.b, far_[1]) || beyond(weight.c, far_[2]);
}

Footpoint PreparedTriangle::closest(const Vec3& p) const { return closest(p, weights(p)); }

Footpoint PreparedTriangle::closest(const Vec3& p, double most) const {
    const Weights weight = weights(p);
    if (is_beyond(p, weight, most)) return {std::numeric_limits<double>::infinity(), p};
    return closest(p, weight);
}

double PreparedTriangle::squared_distance(const Vec3& p, double most) const {
    const Weights weight = weights(p);
    return is_beyond(p, weight, most) ? most : closest(p, weight).squared_distance;
}

Footpoint TriangleShape::closest(const Vec3& p) const { return PreparedTriangle(*this).closest(p); }

std::array<HalfSpace, 3> TriangleShape::sides() const {
    const auto& [a, b, c] = corners;
    const Vec3 normal = (b - a).cross(c - a);
    return {half_space((b - a).cross(normal), a), half_space((c - b).cross(normal), b), half_space((a - c).cross(normal), c)};
}

}  // namespace vsplit
