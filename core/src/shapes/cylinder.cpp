#include "shapes/cylinder.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "shapes/circle.h"

namespace vsplit {
namespace {

constexpr double kFlatNormals = 0.03;  // share of the square of the normals along the axis: 10 degrees in the mean
constexpr double kRingNormals = 0.2;   // least share across it in either direction; 0.5 for a whole turn
constexpr double kScatter = 0.002;     // share of the radius, root mean square: vertices that are off by more were moved
constexpr double kCorner = 0.5;        // of a corner beside the middle of an edge; see fit_faces
constexpr double kFarthest = 0.2;      // the same of any one vertex: what a tolerance may do to a few of them

/// How far points are off a circle.
class OffCircle {
public:
    explicit OffCircle(double radius) : radius_(radius) {}

    void add(double distance) {
        const double off = std::abs(distance / radius_ - 1);
        squares_ += off * off;
        most_ = std::max(most_, off);
        ++count_;
    }
    [[nodiscard]] double mean() const { return std::sqrt(squares_ / static_cast<double>(count_)); }
    [[nodiscard]] bool is_round() const { return mean() <= kRoundness && most_ <= kFarthest; }

private:
    double radius_;
    double squares_ = 0;
    double most_ = 0;
    std::size_t count_ = 0;
};

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

/// Points in the plane across a direction, with weights.
class Section {
public:
    Section(const Vec3& origin, const Vec3& direction)
        : origin_(origin), direction_(direction), u_(direction.unitOrthogonal()), v_(direction.cross(u_)) {}

    void add(const Vec3& p, double weight) {
        points_.emplace_back((p - origin_).dot(u_), (p - origin_).dot(v_));
        weights_.push_back(weight);
    }

    [[nodiscard]] std::optional<Cylinder> cylinder() const {
        const std::optional<Circle> circle = fit_circle(points_, weights_);
        if (!circle) return {};
        return Cylinder{{origin_ + circle->centre[0] * u_ + circle->centre[1] * v_, direction_}, circle->radius, false};
    }

private:
    Vec3 origin_;
    Vec3 direction_;
    Vec3 u_;
    Vec3 v_;
    std::vector<Eigen::Vector2d> points_;
    std::vector<double> weights_;
};

/// The cylinder along a direction through the vertices of a segment's borders.
std::optional<Cylinder> fit_borders(const TriangleMesh& mesh, const Segments::Segment& segment, const Vec3& direction) {
    Section section(middle_of(mesh, segment.loops.front()), direction);
    for (const Segments::Loop& loop : segment.loops) {
        for (const HalfEdge h : loop) section.add(mesh.positions[origin(mesh, h)], 1);
    }
    return section.cylinder();
}

/// The one that a segment's faces swing around: corners are outside of what is meant and the middles of edges inside. Were
/// corners left out, it would be as large as the faces in the mean, and smaller than what was meant by what CAD's chords had cut
/// off already. So much of them is right to 1 % for circles that had 24 to 48 sides and were improved within a fiftieth of
/// the usual edge or a twentieth.
std::optional<Cylinder> fit_faces(const TriangleMesh& mesh, const Segments::Segment& segment, const Vec3& direction) {
    Section section(middle_of(mesh, segment.loops.front()), direction);
    for (const std::uint32_t f : segment.faces) {
        const double area = area_of(mesh, f);
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec3 &p = mesh.positions[mesh.faces[f][i]], &q = mesh.positions[mesh.faces[f][(i + 1) % 3]];
            section.add(p, kCorner * area);
            section.add((p + q) / 2, area);
        }
    }
    return section.cylinder();
}

OffCircle vertices_off(const TriangleMesh& mesh, const Segments::Segment& segment, const Cylinder& cylinder) {
    OffCircle off(cylinder.radius);
    for (const std::uint32_t f : segment.faces) {
        for (const std::uint32_t v : mesh.faces[f]) off.add(cylinder.axis.radial(mesh.positions[v]).norm());
    }
    return off;
}

bool looks_inward(const TriangleMesh& mesh, const FaceNormals& normals, const Segments::Segment& segment, const Axis& axis) {
    double outward = 0;
    for (const std::uint32_t f : segment.faces) {
        for (const std::uint32_t v : mesh.faces[f])
            outward += area_of(mesh, f) * axis.radial(mesh.positions[v]).dot(normals.normals[f]);
    }
    return outward < 0;
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
    double turn = 0, radius = 0;
    for (const HalfEdge h : loop) {
        const Vec3 a = axis.radial(mesh.positions[origin(mesh, h)]), b = axis.radial(mesh.positions[origin(mesh, next(h))]);
        radius += a.norm() / static_cast<double>(loop.size());
        turn += std::atan2(a.cross(b).dot(axis.direction), a.dot(b));
    }
    OffCircle off(radius);
    for (const HalfEdge h : loop) off.add(axis.radial(mesh.positions[origin(mesh, h)]).norm());
    return off.is_round() && std::abs(std::abs(turn) - 2 * std::numbers::pi) < 0.1;
}

std::optional<Cylinder> fit_cylinder(const TriangleMesh& mesh, const FaceNormals& normals, const Segments::Segment& segment) {
    if (segment.loops.size() != 2) return {};
    const std::optional<Vec3> direction = common_direction(mesh, normals, segment);
    if (!direction) return {};
    std::optional<Cylinder> cylinder = fit_borders(mesh, segment, *direction);
    if (!cylinder) return {};
    if (vertices_off(mesh, segment, *cylinder).mean() > kScatter) cylinder = fit_faces(mesh, segment, *direction);
    if (!cylinder || !vertices_off(mesh, segment, *cylinder).is_round()) return {};
    for (const Segments::Loop& loop : segment.loops) {
        if (!is_circle_around(mesh, loop, cylinder->axis)) return {};
    }
    cylinder->inward = looks_inward(mesh, normals, segment, cylinder->axis);
    return cylinder;
}

}  // namespace vsplit
