#include "shapes/cylinder.h"

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

#include "shapes/circle.h"

namespace vsplit {
namespace {

constexpr double kFlatNormals = 0.01;  // share of the square of the normals along the axis: 6 degrees in the mean
constexpr double kRingNormals = 0.2;   // least share across it in either direction; 0.5 for a whole turn

double area_of(const TriangleMesh& mesh, std::uint32_t f) {
    const Triangle& t = mesh.faces[f];
    const Vec3& a = mesh.positions[t[0]];
    return (mesh.positions[t[1]] - a).cross(mesh.positions[t[2]] - a).norm() / 2;
}

/// The direction that no face looks in.
std::optional<Vec3> common_direction(const TriangleMesh& mesh, const FaceNormals& normals, const Segments::Segment& segment) {
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (const std::uint32_t f : segment.faces) {
        if (!normals.reliable[f]) continue;
        spread += area_of(mesh, f) * normals.normals[f] * normals.normals[f].transpose();
    }
    const double all = spread.trace();
    if (!(all > 0)) return {};
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(spread);
    const Vec3 shares = solver.eigenvalues() / all;
    if (shares[0] > kFlatNormals || shares[1] < kRingNormals) return {};
    return Vec3(solver.eigenvectors().col(0));
}

/// The cylinder along a direction through the vertices of a segment's borders.
std::optional<Cylinder> fit_along(const TriangleMesh& mesh, const Segments::Segment& segment, const Vec3& direction) {
    const Vec3 middle = middle_of(mesh, segment.loops.front());
    const Vec3 u = direction.unitOrthogonal(), v = direction.cross(u);
    std::vector<Eigen::Vector2d> points;
    for (const Segments::Loop& loop : segment.loops) {
        for (const HalfEdge h : loop) {
            const Vec3 p = mesh.positions[origin(mesh, h)] - middle;
            points.emplace_back(p.dot(u), p.dot(v));
        }
    }
    const std::optional<Circle> circle = fit_circle(points);
    if (!circle) return {};
    return Cylinder{{middle + circle->centre[0] * u + circle->centre[1] * v, direction}, circle->radius, false};
}

}  // namespace

Vec3 middle_of(const TriangleMesh& mesh, const Segments::Loop& loop) {
    Vec3 sum = Vec3::Zero();
    double length = 0;
    for (const HalfEdge h : loop) {
        const Vec3 &a = mesh.positions[origin(mesh, h)], &b = mesh.positions[origin(mesh, next(h))];
        const double edge = (b - a).norm();
        sum += edge * (a + b) / 2;
        length += edge;
    }
    return length > 0 ? Vec3(sum / length) : mesh.positions[origin(mesh, loop.front())];
}

bool is_circle_around(const TriangleMesh& mesh, const Segments::Loop& loop, const Axis& axis) {
    const double radius = axis.radial(mesh.positions[origin(mesh, loop.front())]).norm();
    double turn = 0;
    for (const HalfEdge h : loop) {
        const Vec3 a = axis.radial(mesh.positions[origin(mesh, h)]), b = axis.radial(mesh.positions[origin(mesh, next(h))]);
        if (std::abs(a.norm() - radius) > 2 * kRoundness * radius) return false;
        turn += std::atan2(a.cross(b).dot(axis.direction), a.dot(b));
    }
    return std::abs(std::abs(turn) - 2 * std::numbers::pi) < 0.1;
}

std::optional<Cylinder> fit_cylinder(const TriangleMesh& mesh, const FaceNormals& normals, const Segments::Segment& segment) {
    if (segment.loops.size() != 2) return {};
    const std::optional<Vec3> direction = common_direction(mesh, normals, segment);
    if (!direction) return {};
    std::optional<Cylinder> cylinder = fit_along(mesh, segment, *direction);
    if (!cylinder) return {};
    double outward = 0;
    for (const std::uint32_t f : segment.faces) {
        for (const std::uint32_t v : mesh.faces[f]) {
            const Vec3 arm = cylinder->axis.radial(mesh.positions[v]);
            if (std::abs(arm.norm() - cylinder->radius) > kRoundness * cylinder->radius) return {};
            outward += area_of(mesh, f) * arm.dot(normals.normals[f]);
        }
    }
    for (const Segments::Loop& loop : segment.loops) {
        if (!is_circle_around(mesh, loop, cylinder->axis)) return {};
    }
    cylinder->inward = outward < 0;
    return cylinder;
}

}  // namespace vsplit
