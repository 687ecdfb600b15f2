#pragma once

#include <optional>

#include "shapes/cylinder.h"
#include "shapes/tubes.h"

namespace vsplit {

/// How a tube runs.
struct Run {
    Vec3 direction = Vec3::Zero();  ///< of a straight one; of one that bends what it bends around, as well as may be; of length 1
    Vec3 centre = Vec3::Zero();     ///< mean of the centres of its sections, by length
    bool straight = false;
};

/// O(sections).
[[nodiscard]] Run run_of(const Tube& tube);

/// A cylinder, or a torus: what is bent at one radius around a line or a circle.
struct TubeSurface {
    Axis axis;       ///< the line, or that of the circle
    double out = 0;  ///< radius of the circle, 0: a line. Its plane goes through the axis' point
    double radius = 0;
    bool convex = false;  ///< faces look away from the line or circle

    /// Across the tube, from its middle.
    [[nodiscard]] Eigen::Vector2d flat(const Vec3& p) const;
    /// What share of the radius a point is off the surface.
    [[nodiscard]] double off(const Vec3& p) const;
    /// Where the surface looks, near a point of it.
    [[nodiscard]] Vec3 normal_at(const Vec3& p) const;
    /// Where the tube runs, of length 1.
    [[nodiscard]] Vec3 along_at(const Vec3& p) const;
};

/// The surface that a tube's vertices lie on; none where they do not, as of a run that is neither straight nor on one circle.
/// O(faces of the tube).
[[nodiscard]] std::optional<TubeSurface> fit_surface(const TriangleMesh& mesh, const Tube& tube);

/// The tube's faces, and those that go on from them on the surface, as strips are not everywhere regular; ascending.
/// \param most_bend radians, of an edge between two of them. O(faces log faces), of those found.
[[nodiscard]] std::vector<std::uint32_t> faces_on(const TubeSurface& surface, const TriangleMesh& mesh,
                                                  const FaceNormals& normals, const std::vector<HalfEdge>& twin, const Tube& tube,
                                                  double most_bend);

}  // namespace vsplit
