#include "quality/sliver_mends.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "quality/flip_rules.h"
#include "spatial/shapes.h"
#include "vsplit/quality/stretch.h"

namespace vsplit {
namespace {

constexpr double kLeastNormalCosine = 0.2;  // a fold is more, as for collapses
constexpr std::size_t kMostFaces = 64;      // around a vertex that may go, as for collapses

class Mender {
public:
    explicit Mender(const MendedMesh& mended)
        : mesh_(mended.mesh),
          marks_(mended.marks),
          normals_(mended.normals),
          source_(mended.source),
          creases_(mended.creases),
          crease_cosine_(std::cos(mended.crease_angle * std::numbers::pi / 180)),
          least_bend_(std::cos(kCreaseBendShare * mended.crease_angle * std::numbers::pi / 180)) {}

    [[nodiscard]] std::optional<double> flip(HalfEdge h) const {
        const HalfEdge g = marks_.twin(h);
        if (g == kNone || marks_.marked(h)) return std::nullopt;
        const Vec3 &a = at(h), &b = at(g), &c = at(prev(h)), &d = at(prev(g));
        if (joined(prev(h), origin(mesh_, prev(g)))) return std::nullopt;
        const TriangleShape left{{d, c, a}}, right{{c, d, b}};
        for (const HalfEdge old : {h, g}) {
            if (is_fold(left, face_of(old), kLeastFlipCosine) || is_fold(right, face_of(old), kLeastFlipCosine))
                return std::nullopt;
        }
        if (!has_fewer_slivers({left, right}, {{{a, b, c}}, {{b, a, d}}})) return std::nullopt;
        if (!keeps_bend(prev(h), left) || !keeps_bend(next(g), left) || !keeps_bend(prev(g), right) ||
            !keeps_bend(next(h), right))
            return std::nullopt;
        if (creases_ != nullptr && !source_keeps_creases_in_flip(h, left, right)) return std::nullopt;
        const Vec3 across = (b - a).cross(d - c);
        const double length = across.norm();
        return std::max(length > 0 ? std::abs(across.dot(c - a)) / length : (c - a).norm(), from_source({left, right}));
    }

    /// The origin of h goes to its target.
    [[nodiscard]] std::optional<double> collapse(HalfEdge h) const {
        const std::vector<HalfEdge> corners = corners_around(h);
        if (corners.empty() || corners.size() > kMostFaces || !keeps_creases(corners, h) || !keeps_topology(corners, h))
            return std::nullopt;
        std::vector<TriangleShape> before, after;
        const Vec3& kept = at(next(h));
        for (const HalfEdge corner : corners) {
            before.push_back({{at(corner), at(next(corner)), at(prev(corner))}});
            if (corner == h || face_of(corner) == face_of(marks_.twin(h))) continue;  // the two that vanish
            after.push_back({{kept, at(next(corner)), at(prev(corner))}});
            if (is_fold(after.back(), face_of(corner), kLeastNormalCosine)) return std::nullopt;
            if (!keeps_bend(next(corner), after.back())) return std::nullopt;
        }
        if (!has_fewer_slivers(after, before)) return std::nullopt;
        if (creases_ != nullptr && !source_keeps_creases(corners, h)) return std::nullopt;
        return std::max(distance_between(at(h), before, after), from_source(after));
    }

private:
    [[nodiscard]] const Vec3& at(HalfEdge h) const { return mesh_.positions[origin(mesh_, h)]; }

    [[nodiscard]] bool is_fold(const TriangleShape& face, std::uint32_t old, double least_cosine) const {
        const Vec3 normal = normal_of(face);
        return !(normal.dot(normals_.normals[old]) > least_cosine * normal.norm());
    }

    [[nodiscard]] static bool is_sliver(const TriangleShape& face) {
        return stretch(face.corners[0], face.corners[1], face.corners[2]) < kStretchFloor;
    }

    [[nodiscard]] static bool has_fewer_slivers(const std::vector<TriangleShape>& after,
                                                const std::vector<TriangleShape>& before) {
        return std::count_if(after.begin(), after.end(), is_sliver) < std::count_if(before.begin(), before.end(), is_sliver);
    }

    /// Whether the edge of `side`, if it is a crease, bends enough with `face` on this side of it.
    [[nodiscard]] bool keeps_bend(HalfEdge side, const TriangleShape& face) const {
        const HalfEdge twin = marks_.twin(side);
        if (twin == kNone || !marks_.marked(side)) return true;
        const Vec3& beyond = normals_.normals[face_of(twin)];
        if (normals_.normals[face_of(side)].dot(beyond) >= crease_cosine_) return true;
        const Vec3 normal = normal_of(face);
        return normal.dot(beyond) < crease_cosine_ * normal.norm();
    }

    /// Whether creases that go with the origin of h, or bend no longer, leave others where the source has some.
    [[nodiscard]] bool source_keeps_creases(const std::vector<HalfEdge>& corners, HalfEdge h) const {
        const HalfEdge g = marks_.twin(h);
        std::vector<HalfEdge> before;
        std::vector<SegmentShape> after;
        const auto take = [&](HalfEdge edge) {
            if (creases_->is_crease(edge)) before.push_back(edge);
        };
        for (const HalfEdge corner : corners) {
            const HalfEdge side = next(corner);
            take(corner);
            take(side);
            if (corner != h && still_bends(corner, h)) after.push_back({{at(next(h)), at(side)}});
            const bool vanishes = face_of(corner) == face_of(h) || face_of(corner) == face_of(g);
            if (!vanishes && side_still_bends(side, h)) after.push_back({{at(side), at(next(side))}});
        }
        // At the other end, those that stay as they are.
        for (const HalfEdge corner : corners_around(next(h))) {
            const bool changes = corner == g || corner == next(h) || corner == marks_.twin(prev(g));
            if (creases_->is_crease(corner) && !changes) after.push_back({{at(corner), at(next(corner))}});
        }
        return creases_->may_become(before, after);
    }

    /// Whether a side of the fan around the origin of h is a crease when that has gone to the target of h.
    [[nodiscard]] bool side_still_bends(HalfEdge side, HalfEdge h) const {
        const HalfEdge beyond = marks_.twin(side);
        return beyond == kNone || is_flat_crease(side) || bends(normal_after(side, h), normals_.normals[face_of(beyond)]);
    }

    /// Whether it is one that no bend tells.
    [[nodiscard]] bool is_flat_crease(HalfEdge edge) const {
        return marks_.marked(edge) &&
               normals_.normals[face_of(edge)].dot(normals_.normals[face_of(marks_.twin(edge))]) >= least_bend_;
    }

    /// The same of an edge that turns into the faces `left`, in place of that of h, and `right`.
    [[nodiscard]] bool source_keeps_creases_in_flip(HalfEdge h, const TriangleShape& left, const TriangleShape& right) const {
        const HalfEdge g = marks_.twin(h);
        std::vector<HalfEdge> before;
        std::vector<SegmentShape> after;
        if (creases_->is_crease(h)) before.push_back(h);
        const Vec3 of_left = normal_of(left), of_right = normal_of(right);
        if (bends(of_left, of_right)) after.push_back({{at(prev(h)), at(prev(g))}});
        for (const HalfEdge side : {prev(h), next(g), prev(g), next(h)}) {
            if (creases_->is_crease(side)) before.push_back(side);
            const HalfEdge beyond = marks_.twin(side);
            const bool is_left = side == prev(h) || side == next(g);
            if (beyond == kNone || bends(is_left ? of_left : of_right, normals_.normals[face_of(beyond)]))
                after.push_back({{at(side), at(next(side))}});
        }
        return creases_->may_become(before, after);
    }

    [[nodiscard]] bool bends(const Vec3& one, const Vec3& other) const {
        return one.dot(other) < least_bend_ * one.norm() * other.norm();
    }

    /// Whether the edge of `corner` is a crease when its origin has gone to the target of h.
    [[nodiscard]] bool still_bends(HalfEdge corner, HalfEdge h) const {
        if (is_flat_crease(corner)) return true;
        const Vec3 one = normal_after(corner, h), other = normal_after(marks_.twin(corner), h);
        return bends(one, other);
    }

    /// Of the face of `side`, an edge at the origin of h, when that has gone to the target of h; of the face beyond where that
    /// one vanishes.
    [[nodiscard]] Vec3 normal_after(HalfEdge side, HalfEdge h) const {
        const HalfEdge g = marks_.twin(h);
        if (face_of(side) == face_of(h) || face_of(side) == face_of(g)) {
            const HalfEdge beyond = marks_.twin(face_of(side) == face_of(h) ? next(h) : prev(g));
            return beyond == kNone ? Vec3(normals_.normals[face_of(side)]) : Vec3(normals_.normals[face_of(beyond)]);
        }
        TriangleShape face{{at(side), at(next(side)), at(prev(side))}};
        const std::array<HalfEdge, 3> all{side, next(side), prev(side)};
        for (std::size_t n = 0; n < all.size(); ++n) {
            if (origin(mesh_, all[n]) == origin(mesh_, h)) face.corners[n] = at(next(h));
        }
        return normal_of(face);
    }

    /// How far faces are from the source, at their corners, centroids and the middles of their edges.
    [[nodiscard]] double from_source(const std::vector<TriangleShape>& faces) const {
        if (source_ == nullptr) return 0;
        double most = 0;
        const auto look_at = [&](const Vec3& p) { most = std::max(most, source_->closest(p).squared_distance); };
        for (const TriangleShape& face : faces) {
            const auto& [a, b, c] = face.corners;
            for (const Vec3& p : {a, b, c, Vec3((a + b + c) / 3), Vec3((a + b) / 2), Vec3((b + c) / 2), Vec3((c + a) / 2)})
                look_at(p);
        }
        return std::sqrt(most);
    }

    /// As long as twice the area.
    [[nodiscard]] static Vec3 normal_of(const TriangleShape& face) {
        const auto& [a, b, c] = face.corners;
        return (b - a).cross(c - a);
    }

    /// The half-edges that leave the origin of h; empty on a boundary.
    [[nodiscard]] std::vector<HalfEdge> corners_around(HalfEdge h) const {
        std::vector<HalfEdge> corners;
        HalfEdge corner = h;
        do {
            corners.push_back(corner);
            corner = marks_.twin(prev(corner));
            if (corner == kNone) return {};
        } while (corner != h);
        return corners;
    }

    [[nodiscard]] bool joined(HalfEdge h, std::uint32_t to) const {
        const std::vector<HalfEdge> corners = corners_around(h);
        return std::any_of(corners.begin(), corners.end(), [&](HalfEdge corner) { return origin(mesh_, next(corner)) == to; });
    }

    /// A vertex of a crease goes along that crease only, a corner not at all.
    [[nodiscard]] bool keeps_creases(const std::vector<HalfEdge>& corners, HalfEdge h) const {
        const auto creases = std::count_if(corners.begin(), corners.end(), [&](HalfEdge c) { return marks_.marked(c); });
        return creases == 0 || (creases == 2 && marks_.marked(h));
    }

    /// The link condition: both ends share two neighbours.
    [[nodiscard]] bool keeps_topology(const std::vector<HalfEdge>& corners, HalfEdge h) const {
        const std::vector<HalfEdge> others = corners_around(next(h));
        std::vector<std::uint32_t> neighbours;
        for (const HalfEdge corner : others) neighbours.push_back(origin(mesh_, next(corner)));
        const auto shared = std::count_if(corners.begin(), corners.end(), [&](HalfEdge corner) {
            return std::find(neighbours.begin(), neighbours.end(), origin(mesh_, next(corner))) != neighbours.end();
        });
        return shared == 2 && corners.size() > 3 && !others.empty();
    }

    static double distance_to(const Vec3& p, const std::vector<TriangleShape>& faces) {
        double least = std::numeric_limits<double>::infinity();
        for (const TriangleShape& face : faces) least = std::min(least, face.closest(p).squared_distance);
        return std::sqrt(least);
    }

    static double distance_between(const Vec3& gone, const std::vector<TriangleShape>& before,
                                   const std::vector<TriangleShape>& after) {
        const auto centroid = [](const TriangleShape& t) { return Vec3((t.corners[0] + t.corners[1] + t.corners[2]) / 3); };
        double most = distance_to(gone, after);
        for (const TriangleShape& face : before) most = std::max(most, distance_to(centroid(face), after));
        for (const TriangleShape& face : after) most = std::max(most, distance_to(centroid(face), before));
        return most;
    }

    const TriangleMesh& mesh_;
    const CreaseMarks& marks_;
    const FaceNormals& normals_;
    const SurfaceIndex* source_;
    const HeldCreases* creases_;
    double crease_cosine_;
    double least_bend_;  // of what counts as a crease, a cosine
};

}  // namespace

std::optional<double> least_mend(const MendedMesh& mended, const SliverFace& face) {
    const Mender mender(mended);
    std::optional<double> least;
    const auto take = [&](const std::optional<double>& moved) {
        if (moved && (!least || *moved < *least)) least = moved;
    };
    for (const HalfEdge h : {face.longest, next(face.longest), prev(face.longest)}) {
        const HalfEdge twin = mended.marks.twin(h);
        if (twin == kNone) continue;  // a boundary stays
        take(mender.flip(h));
        take(mender.collapse(h));
        take(mender.collapse(twin));
    }
    return least;
}

}  // namespace vsplit
