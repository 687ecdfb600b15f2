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

Footpoint TriangleShape::closest(const Vec3& p) const {
    const auto& [a, b, c] = corners;
    const Vec3 ab = b - a;
    const Vec3 ac = c - a;
    const Vec3 ap = p - a;
    const Vec3 normal = ab.cross(ac);
    // Barycentric weights of the projection of p, times |normal|^2. Through the normal they keep a relative error of rounding
    // over (height / length); the Gram determinants of the usual form would square that.
    const double whole = normal.squaredNorm();
    const double weight_b = normal.dot(ap.cross(ac));
    const double weight_c = normal.dot(ab.cross(ap));
    const double weight_a = whole - weight_b - weight_c;
    const double longest = std::max({ab.squaredNorm(), ac.squaredNorm(), (c - b).squaredNorm()});
    const bool thin = !(whole > kThin * longest * longest);
    const double border = kBorder * whole;
    const bool inside = weight_a > border && weight_b > border && weight_c > border;

    Footpoint best{ap.squaredNorm(), a};
    if (inside) {
        const Vec3 q = a + ab * (weight_b / whole) + ac * (weight_c / whole);
        if (!thin) return {(p - q).squaredNorm(), q};
        keep_nearer(best, {(p - q).squaredNorm(), q});
    }
    // From outside, the nearest point is on an edge whose line separates p's projection from the triangle.
    if (thin || weight_c <= border) keep_nearer(best, closest_on_segment(a, b, p));
    if (thin || weight_b <= border) keep_nearer(best, closest_on_segment(a, c, p));
    if (thin || weight_a <= border) keep_nearer(best, closest_on_segment(b, c, p));
    return best;
}

std::array<HalfSpace, 3> TriangleShape::sides() const {
    const auto& [a, b, c] = corners;
    const Vec3 normal = (b - a).cross(c - a);
    return {half_space((b - a).cross(normal), a), half_space((c - b).cross(normal), b), half_space((a - c).cross(normal), c)};
}

}  // namespace vsplit
