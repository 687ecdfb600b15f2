#include "vsplit/quality/stretch.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "quality/face_shape.h"

namespace vsplit {

double stretch(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 ab = b - a;
    const Vec3 ac = c - a;
    return stretch_of(ab.norm(), (c - b).norm(), ac.norm(), ab.cross(ac).norm());
}

double face_size(const Vec3& a, const Vec3& b, const Vec3& c) {
    return std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
}

}  // namespace vsplit
