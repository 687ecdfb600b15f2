#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "features/crease_marks.h"
#include "vsplit/features/face_normals.h"
#include "vsplit/sizing/size_field.h"

namespace vsplit {
namespace {

/// Corners at a vertex whose faces are joined across edges that are no creases: a sector, where the surface has one normal.
class Sectors {
public:
    explicit Sectors(const CreaseMarks& creases) : leader_(creases.half_edge_count()) {
        std::iota(leader_.begin(), leader_.end(), 0U);
        for (HalfEdge h = 0; h < creases.half_edge_count(); ++h) {
            const HalfEdge twin = creases.twin(h);
            if (twin != kNone && !creases.marked(h)) join(h, next(twin));
        }
    }

    [[nodiscard]] HalfEdge of(HalfEdge corner) {
        while (leader_[corner] != corner) corner = leader_[corner] = leader_[leader_[corner]];
        return corner;
    }

private:
    void join(HalfEdge a, HalfEdge b) {
        a = of(a);
        b = of(b);
        leader_[std::max(a, b)] = std::min(a, b);
    }

    std::vector<HalfEdge> leader_;
};

double corner_angle(const TriangleMesh& mesh, HalfEdge h) {
    const Vec3& at = mesh.positions[origin(mesh, h)];
    const Vec3 left = mesh.positions[origin(mesh, next(h))] - at;
    const Vec3 right = mesh.positions[origin(mesh, prev(h))] - at;
    return std::atan2(left.cross(right).norm(), left.dot(right));
}

/// The normal at each corner: its sector's faces by their angles, which says the same however a face is cut.
std::vector<Vec3> corner_normals(const TriangleMesh& mesh, const CreaseMarks& creases) {
    const FaceNormals normals = face_normals(mesh);
    Sectors sectors(creases);
    std::vector<Vec3> sums(creases.half_edge_count(), Vec3::Zero());
    for (HalfEdge h = 0; h < sums.size(); ++h) sums[sectors.of(h)] += corner_angle(mesh, h) * normals.normals[face_of(h)];
    std::vector<Vec3> result(sums.size());
    for (HalfEdge h = 0; h < sums.size(); ++h) {
        const Vec3& sum = sums[sectors.of(h)];
        result[h] = sum.squaredNorm() > 0 ? Vec3(sum.normalized()) : Vec3::Zero();
    }
    return result;
}

}  // namespace

std::vector<double> largest_curvature(const TriangleMesh& mesh, const std::vector<SharpEdge>& creases) {
    CreaseMarks marks(mesh);
    marks.mark(creases);
    const std::vector<Vec3> normals = corner_normals(mesh, marks);
    std::vector<double> curvature(mesh.positions.size(), 0);
    for (HalfEdge h = 0; h < normals.size(); ++h) {
        const std::uint32_t a = origin(mesh, h);
        const std::uint32_t b = origin(mesh, next(h));
        const Vec3 way = mesh.positions[b] - mesh.positions[a];
        const double square = way.squaredNorm();
        if (!(square > 0)) continue;
        const double bend = std::abs((normals[next(h)] - normals[h]).dot(way)) / square;
        curvature[a] = std::max(curvature[a], bend);
        curvature[b] = std::max(curvature[b], bend);
    }
    return curvature;
}

}  // namespace vsplit
