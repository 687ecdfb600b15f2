#include "vsplit/simplify/quadric.h"

namespace vsplit {

Quadric Quadric::plane(const Vec3& normal, const Vec3& point) {
    const double d = -normal.dot(point);
    const Vec3 b = d * normal;
    return {normal.x() * normal.x(),
            normal.x() * normal.y(),
            normal.x() * normal.z(),
            normal.y() * normal.y(),
            normal.y() * normal.z(),
            normal.z() * normal.z(),
            b,
            d * d};
}

Quadric Quadric::line(const Vec3& direction, const Vec3& point, double weight) {
    const Vec3& d = direction;
    const double along = d.dot(point);
    const Vec3 b = -weight * (point - along * d);
    return {weight * (1 - d.x() * d.x()),
            -weight * d.x() * d.y(),
            -weight * d.x() * d.z(),
            weight * (1 - d.y() * d.y()),
            -weight * d.y() * d.z(),
            weight * (1 - d.z() * d.z()),
            b,
            weight * (point.squaredNorm() - along * along)};
}

}  // namespace vsplit
