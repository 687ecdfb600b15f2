#include "quality/sliver_features.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "quality/crease_gap.h"
#include "quality/sliver_bounds.h"
#include "vsplit/quality/stretch.h"

namespace vsplit {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;
constexpr double kCornerCosine = 0.766044443118978;  // a crease that turns by more than 40 degrees has a corner there

const double kHeight = height_for_stretch(kStretchFloor);
const double kShortEdge = short_edge_for_stretch(kStretchFloor);
const double kAngle = angle_for_stretch(kStretchFloor);

bool contains(const std::vector<std::uint32_t>& all, std::uint32_t v) {
    return std::find(all.begin(), all.end(), v) != all.end();
}

}  // namespace

/// The angles around the origin of `corner` from its face to the next crease either way; more than `limit` where they are.
double SliverFeatures::sector(HalfEdge corner, double limit) const {
    const auto angle_at = [&](HalfEdge h) {
        const Vec3& at = position(origin(mesh_, h));
        const Vec3 left = position(origin(mesh_, prev(h))) - at;
        const Vec3 right = position(origin(mesh_, next(h))) - at;
        return std::atan2(left.cross(right).norm(), left.dot(right));
    };
    double sum = angle_at(corner);
    for (HalfEdge h = corner; sum <= limit && !marks_.marked(prev(h)) && marks_.twin(prev(h)) != kNone;) {
        h = marks_.twin(prev(h));
        if (h == corner) return limit + 1;  // all around: no crease
        sum += angle_at(h);
    }
    for (HalfEdge h = corner; sum <= limit && !marks_.marked(h) && marks_.twin(h) != kNone;) {
        h = next(marks_.twin(h));
        if (h == corner) return limit + 1;
        sum += angle_at(h);
    }
    return sum;
}

SliverFeatures::Vertices SliverFeatures::crease_neighbours(HalfEdge first) const {
    Vertices found;
    const auto visit = [&](HalfEdge edge, std::uint32_t other) {
        if (marks_.marked(edge) || marks_.twin(edge) == kNone) found.push_back(other);
    };
    for (HalfEdge h = first;;) {
        visit(h, origin(mesh_, next(h)));
        const HalfEdge before = prev(h);
        if (marks_.twin(before) == kNone) {
            visit(before, origin(mesh_, before));
            break;
        }
        h = marks_.twin(before);
        if (h == first) return found;
    }
    // A boundary ended the way round: the other way, up to the boundary there.
    for (HalfEdge h = first; marks_.twin(h) != kNone;) {
        h = next(marks_.twin(h));
        visit(h, origin(mesh_, next(h)));
    }
    return found;
}

bool SliverFeatures::is_corner(HalfEdge h) const {
    const Vertices others = crease_neighbours(h);
    if (others.size() != 2) return !others.empty();
    const Vec3& at = position(origin(mesh_, h));
    const Vec3 in = at - position(others[0]);
    const Vec3 out = position(others[1]) - at;
    return in.dot(out) < kCornerCosine * in.norm() * out.norm();
}

/// Whether a crease, of one edge or two, joins the ends of `edge`: then they are no two creases.
bool SliverFeatures::joined(HalfEdge edge) const {
    const Vertices of_start = crease_neighbours(edge);
    const Vertices of_end = crease_neighbours(next(edge));
    if (contains(of_start, origin(mesh_, next(edge)))) return true;
    return std::any_of(of_start.begin(), of_start.end(), [&](std::uint32_t v) { return contains(of_end, v); });
}

std::optional<double> SliverFeatures::sharp_corner(const SliverFace& face) const {
    std::optional<double> least;
    for (const HalfEdge h : {face.longest, next(face.longest), prev(face.longest)}) {
        if (crease_neighbours(h).size() < 2) continue;
        const double angle = sector(h, kAngle);
        if (angle < kAngle && (!least || angle * kDegrees < *least)) least = angle * kDegrees;
    }
    return least;
}

std::optional<double> SliverFeatures::narrow_strip(const SliverFace& face) const {
    const double reach = kHeight * face.wanted;
    if (const std::optional<double> gap = crease_gap(mesh_, marks_, face.longest, reach)) return gap;

    const HalfEdge apex = prev(face.longest);
    const Vertices of_apex = crease_neighbours(apex);
    const std::uint32_t a = origin(mesh_, face.longest), b = origin(mesh_, next(face.longest)), c = origin(mesh_, apex);
    const Vec3 side = position(b) - position(a);
    const double height = face.length > 0 ? side.cross(position(c) - position(a)).norm() / face.length : 0;
    const bool over_crease = marks_.marked(face.longest) && !of_apex.empty() && !contains(of_apex, a) && !contains(of_apex, b);
    if (over_crease && height < reach) return height;

    const double shortest = (position(origin(mesh_, next(face.shortest))) - position(origin(mesh_, face.shortest))).norm();
    if (!(shortest < kShortEdge * face.wanted) || joined(face.shortest)) return std::nullopt;
    const bool both = !crease_neighbours(face.shortest).empty() && !crease_neighbours(next(face.shortest)).empty();
    return both ? std::optional(shortest) : std::nullopt;
}

std::optional<double> SliverFeatures::close_corners(const SliverFace& face) const {
    const double shortest = (position(origin(mesh_, next(face.shortest))) - position(origin(mesh_, face.shortest))).norm();
    if (!(shortest < kShortEdge * face.wanted)) return std::nullopt;
    return is_corner(face.shortest) && is_corner(next(face.shortest)) ? std::optional(shortest) : std::nullopt;
}

/// Follows the cut of the surface with the plane through the middle of the face, across its longest edge. Vertices are on one
/// side or the other, none on the plane, so each face that is cut is cut through two edges, and the walk ends where it began.
std::optional<double> SliverFeatures::narrow_part(const SliverFace& face) const {
    const double limit = 2 * kHeight * face.wanted;
    const Vec3& from = position(origin(mesh_, face.longest));
    const Vec3 along = position(origin(mesh_, next(face.longest))) - from;
    const Vec3 middle = (from + position(origin(mesh_, next(face.longest))) + position(origin(mesh_, prev(face.longest)))) / 3;
    const auto side = [&](HalfEdge h) { return (position(origin(mesh_, h)) - middle).dot(along); };
    const auto point_on = [&](HalfEdge h) -> Vec3 {
        const double begin = side(h), end = side(next(h));
        const Vec3& p = position(origin(mesh_, h));
        return p + (position(origin(mesh_, next(h))) - p) * (begin / (begin - end));
    };
    const auto crosses = [&](HalfEdge h) { return (side(h) >= 0) != (side(next(h)) >= 0); };
    if (!crosses(face.longest)) return std::nullopt;  // no area
    double girth = 0;
    Vec3 at = point_on(face.longest);
    for (HalfEdge h = face.longest;;) {
        h = crosses(next(h)) ? next(h) : prev(h);
        const Vec3 there = point_on(h);
        girth += (there - at).norm();
        at = there;
        h = marks_.twin(h);
        if (h == face.longest) return girth < limit ? std::optional(girth) : std::nullopt;
        if (h == kNone || !(girth < limit)) return std::nullopt;
    }
}

}  // namespace vsplit
