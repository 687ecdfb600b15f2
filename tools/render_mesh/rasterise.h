#pragma once

#include "picture.h"
#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit::render {

/// Axes of a parallel projection, orthonormal: x to the right, y up, z towards the viewer.
struct Camera {
    Vec3 right = Vec3::UnitX();
    Vec3 up = Vec3::UnitY();
    Vec3 toward = Vec3::UnitZ();
};

/// Looks at the origin with model axis `up_axis` (0, 1 or 2) upright. `azimuth` turns around it and `elevation` lifts the eye,
/// both in degrees.
[[nodiscard]] Camera orbit_camera(int up_axis, double azimuth, double elevation);

/// The part of the camera's plane that a picture shows.
struct View {
    double centre_x = 0;         ///< model units
    double centre_y = 0;         ///< model units
    double units_per_pixel = 1;  ///< model units
};

/// The view that shows all the meshes' points with a margin.
[[nodiscard]] View fit_view(const Camera& camera, const std::vector<const TriangleMesh*>& meshes, int width, int height);

/// Draws the faces coloured by stretch, flat shaded, with their edges. O(faces + pixels).
[[nodiscard]] Picture draw_mesh(const TriangleMesh& mesh, const Camera& camera, const View& view, int width, int height);

}  // namespace vsplit::render
