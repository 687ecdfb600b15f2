#include "vsplit/mesh/triangle_mesh.h"

#include <Eigen/Geometry>

namespace vsplit {

BoundingBox bounding_box(const TriangleMesh& mesh) {
    BoundingBox box;
    for (const Vec3& p : mesh.positions) {
        box.min = box.min.cwiseMin(p);
        box.max = box.max.cwiseMax(p);
    }
    return box;
}

double surface_area(const TriangleMesh& mesh) {
    double twice = 0;
    for (const Triangle& f : mesh.faces) {
        const Vec3& a = mesh.positions[f[0]];
        twice += (mesh.positions[f[1]] - a).cross(mesh.positions[f[2]] - a).norm();
    }
    return twice / 2;
}

double enclosed_volume(const TriangleMesh& mesh) {
    if (mesh.positions.empty()) return 0;
    const Vec3 origin = mesh.positions.front();  // near the mesh, so that far-away coordinates do not cancel
    double six_times = 0;
    for (const Triangle& f : mesh.faces) {
        const Vec3 a = mesh.positions[f[0]] - origin;
        const Vec3 b = mesh.positions[f[1]] - origin;
        const Vec3 c = mesh.positions[f[2]] - origin;
        six_times += a.dot(b.cross(c));
    }
    return six_times / 6;
}

}  // namespace vsplit
