#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "quality/face_bounds.h"
#include "quality/flip_rules.h"
#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// Whether an edge (a, b) between the faces (a, b, c) and (b, a, d) is not Delaunay: d lies inside the circle of a, b, c, so that
/// the angles at c and d are more than 180 degrees together.
[[nodiscard]] inline bool is_within_circle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    constexpr double kLeast = 1e-9;
    const Vec3 ca = a - c, cb = b - c, da = a - d, db = b - d;
    const double lengths = ca.norm() * cb.norm() * da.norm() * db.norm();
    return ca.cross(cb).norm() * da.dot(db) + ca.dot(cb) * da.cross(db).norm() < -kLeast * lengths;
}

/// The faces (a, b, c) and (b, a, d) of an edge, which a flip would make (d, c, a) and (c, d, b), in space.
struct FlipQuad {
    /// A face that the flip would make.
    struct Face {
        Vec3 normal = Vec3::Zero();  // not unit while degenerate
        double stretch = 0;
        double size = 0;

        Face(const Vec3& a, const Vec3& b, const Vec3& c) {
            const Vec3 cross = (b - a).cross(c - a);
            const double twice_area = cross.norm();
            const double ab = (b - a).norm(), bc = (c - b).norm(), ca = (a - c).norm();
            stretch = stretch_of(ab, bc, ca, twice_area);
            size = std::max({ab, bc, ca});
            normal = twice_area > 0 ? Vec3(cross / twice_area) : cross;
        }
    };

    Vec3 pa, pb, pc, pd;
    Vec3 normal_before, twin_normal_before;  // of the two faces as they are; unit
    Face left, right;

    FlipQuad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec3& normal, const Vec3& twin_normal)
        : pa(a), pb(b), pc(c), pd(d), normal_before(normal), twin_normal_before(twin_normal), left(d, c, a), right(c, d, b) {}

    [[nodiscard]] double least_stretch() const { return std::min(left.stretch, right.stretch); }
    [[nodiscard]] double least_stretch_before() const { return std::min(Face(pa, pb, pc).stretch, Face(pb, pa, pd).stretch); }

    [[nodiscard]] bool normals_stay() const {
        return std::min({left.normal.dot(normal_before), left.normal.dot(twin_normal_before), right.normal.dot(normal_before),
                         right.normal.dot(twin_normal_before)}) >= kLeastFlipCosine;
    }

    /// Whether the two diagonals pass each other within `gap`: what the flip moves the surface by.
    [[nodiscard]] bool moves_surface_within(double most) const {
        const Vec3 across = (pb - pa).cross(pd - pc);
        return std::abs(across.dot(pc - pa)) <= most * across.norm();
    }

    /// How far the diagonals pass each other; infinity where they are parallel.
    [[nodiscard]] double gap() const {
        const Vec3 across = (pb - pa).cross(pd - pc);
        const double length = across.norm();
        return length > 0 ? std::abs(across.dot(pc - pa)) / length : std::numeric_limits<double>::infinity();
    }

    [[nodiscard]] Excess excess_before(const FaceBounds& bounds) const {
        return sum(bounds.excess({pa, pb, pc}), bounds.excess({pb, pa, pd}));
    }
    [[nodiscard]] Excess excess_after(const FaceBounds& bounds) const {
        return sum(bounds.excess({pd, pc, pa}), bounds.excess({pc, pd, pb}));
    }

private:
    [[nodiscard]] static Excess sum(Excess one, const Excess& other) {
        one.add(other);
        return one;
    }
};

}  // namespace vsplit
