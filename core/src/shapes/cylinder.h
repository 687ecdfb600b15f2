#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "shapes/segments.h"

namespace vsplit {

struct Axis {
    Vec3 point = Vec3::Zero();
    Vec3 direction = Vec3::UnitZ();  ///< of length 1

    [[nodiscard]] double along(const Vec3& p) const { return (p - point).dot(direction); }
    [[nodiscard]] Vec3 radial(const Vec3& p) const { return p - point - along(p) * direction; }
};

/// A whole cylinder, open at both ends.
struct Cylinder {
    Axis axis;
    double radius = 0;
    bool inward = false;  ///< faces look at the axis, as in a hole
};

/// What share of a radius vertices may be off their circle, in the root mean square.
inline constexpr double kRoundness = 0.05;

/// The cylinder that a segment of two borders is, if it is one: faces along an axis, vertices at one distance from it, all the
/// way around. It is that through the vertices of the borders, as CAD puts them on it; where the vertices scatter, as those that
/// a mesher moved within a tolerance do, it is that in the middle of the faces. O(faces of the segment).
[[nodiscard]] std::optional<Cylinder> fit_cylinder(const TriangleMesh& mesh, const FaceNormals& normals,
                                                   const Segments::Segment& segment);

/// Whether a loop goes around the axis once, at one distance from it.
[[nodiscard]] bool is_circle_around(const TriangleMesh& mesh, const Segments::Loop& loop, const Axis& axis);

/// The mean of the loop's points, by length.
[[nodiscard]] Vec3 middle_of(const TriangleMesh& mesh, const Segments::Loop& loop);

}  // namespace vsplit
