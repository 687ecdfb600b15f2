#include "vsplit/features/face_normals.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "mesh/half_edges.h"

namespace vsplit {
namespace {

/// Coordinates are as good as single precision at best (STL has no more): a height under a few of its steps is rounding.
constexpr double kRoundingSteps = 8;

double coordinate_step(const TriangleMesh& mesh) {
    double largest = 0;
    for (const Vec3& p : mesh.positions) largest = std::max(largest, p.cwiseAbs().maxCoeff());
    return largest * static_cast<double>(std::numeric_limits<float>::epsilon()) / 2;
}

/// Corners of a face with the start of its longest edge first, then the next longest: the order to ask neighbours in.
std::array<HalfEdge, 3> edges_by_length(const TriangleMesh& mesh, std::uint32_t face) {
    std::array<HalfEdge, 3> order{3 * face, 3 * face + 1, 3 * face + 2};
    const auto length = [&](HalfEdge h) {
        return (mesh.positions[origin(mesh, next(h))] - mesh.positions[origin(mesh, h)]).squaredNorm();
    };
    std::stable_sort(order.begin(), order.end(), [&](HalfEdge left, HalfEdge right) { return length(left) > length(right); });
    return order;
}

/// The first of the face's neighbours, across the longest edge first, whose normal is known; kNone where there is none.
std::uint32_t known_neighbour(const TriangleMesh& mesh, const std::vector<HalfEdge>& twins, const std::vector<bool>& known,
                              std::uint32_t face) {
    for (const HalfEdge h : edges_by_length(mesh, face)) {
        if (twins[h] != kNone && known[face_of(twins[h])]) return face_of(twins[h]);
    }
    return kNone;
}

}  // namespace

FaceNormals face_normals(const TriangleMesh& mesh) {
    const double least_height = kRoundingSteps * coordinate_step(mesh);
    FaceNormals result;
    result.normals.assign(mesh.faces.size(), Vec3::Zero());
    result.reliable.assign(mesh.faces.size(), false);
    std::vector<std::uint32_t> unknown;
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        const Triangle& t = mesh.faces[f];
        const Vec3 ab = mesh.positions[t[1]] - mesh.positions[t[0]];
        const Vec3 ac = mesh.positions[t[2]] - mesh.positions[t[0]];
        const Vec3 bc = mesh.positions[t[2]] - mesh.positions[t[1]];
        const Vec3 cross = ab.cross(ac);
        const double twice_area = cross.norm();
        const double longest = std::sqrt(std::max({ab.squaredNorm(), ac.squaredNorm(), bc.squaredNorm()}));
        if (twice_area > 0) result.normals[f] = cross / twice_area;
        result.reliable[f] = twice_area > least_height * longest;
        if (!result.reliable[f]) unknown.push_back(f);
    }
    if (unknown.empty()) return result;

    // Slivers border slivers: normals spread inwards a ring a round. Every face of a round reads the round before.
    const std::vector<HalfEdge> twins = half_edge_twins(mesh);
    std::vector<bool> known = result.reliable;
    while (!unknown.empty()) {
        std::vector<std::uint32_t> left;
        std::vector<std::uint32_t> settled;
        for (const std::uint32_t f : unknown) {
            const std::uint32_t lender = known_neighbour(mesh, twins, known, f);
            if (lender == kNone) {
                left.push_back(f);
                continue;
            }
            result.normals[f] = result.normals[lender];
            settled.push_back(f);
        }
        if (settled.empty()) break;
        for (const std::uint32_t f : settled) known[f] = true;
        unknown.swap(left);
    }
    return result;
}

}  // namespace vsplit
