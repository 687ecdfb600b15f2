#include "spatial/shapes.h"

#include <Eigen/Geometry>
#include <algorithm>

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

PreparedTriangle::PreparedTriangle(const TriangleShape& shape)
    : a_(shape.corners[0]), b_(shape.corners[1]), c_(shape.corners[2]), ab_(b_ - a_), ac_(c_ - a_), normal_(ab_.cross(ac_)) {
    whole_ = normal_.squaredNorm();
    const double ab = ab_.squaredNorm(), ac = ac_.squaredNorm(), bc = (c_ - b_).squaredNorm();
    const double longest = std::max({ab, ac, bc});
    thin_ = !(whole_ > kThin * longest * longest);
    border_ = kBorder * whole_;
    far_ = {whole_ * bc, whole_ * ac, whole_ * ab};
}

PreparedTriangle::Weights PreparedTriangle::weights(const Vec3& p) const {
    const Vec3 ap = p - a_;
    const double weight_b = normal_.dot(ap.cross(ac_));
    const double weight_c = normal_.dot(ab_.cross(ap));
    return {whole_ - weight_b - weight_c, weight_b, weight_c};
}

Footpoint PreparedTriangle::closest(const Vec3& p, const Weights& weight) const {
    const bool inside = weight.a > border_ && weight.b > border_ && weight.c > border_;
    Footpoint best{(p - a_).squaredNorm(), a_};
    if (inside) {
        const Vec3 q = a_ + ab_ * (weight.b / whole_) + ac_ * (weight.c / whole_);
        if (!thin_) return {(p - q).squaredNorm(), q};
        keep_nearer(best, {(p - q).squaredNorm(), q});
    }
    // From outside, the nearest point is on an edge whose line separates p's projection from the triangle.
    if (thin_ || weight.c <= border_) keep_nearer(best, closest_on_segment(a_, b_, p));
    if (thin_ || weight.b <= border_) keep_nearer(best, closest_on_segment(a_, c_, p));
    if (thin_ || weight.a <= border_) keep_nearer(best, closest_on_segment(b_, c_, p));
    return best;
}

bool PreparedTriangle::is_beyond(const Weights& weight, double most) const {
    constexpr double kRounding = 1.001;
    const auto beyond = [most](double w, double far) { return w < 0 && w * w > kRounding * most * far; };
    return !thin_ && (beyond(weight.a, far_[0]) || beyond(weight.b, far_[1]) || beyond(weight.c, far_[2]));
}

Footpoint PreparedTriangle::closest(const Vec3& p) const { return closest(p, weights(p)); }

double PreparedTriangle::squared_distance(const Vec3& p, double most) const {
    const Weights weight = weights(p);
    return is_beyond(weight, most) ? most : closest(p, weight).squared_distance;
}

Footpoint TriangleShape::closest(const Vec3& p) const { return PreparedTriangle(*this).closest(p); }

std::array<HalfSpace, 3> TriangleShape::sides() const {
    const auto& [a, b, c] = corners;
    const Vec3 normal = (b - a).cross(c - a);
    return {half_space((b - a).cross(normal), a), half_space((c - b).cross(normal), b), half_space((a - c).cross(normal), c)};
}

}  // namespace vsplit
