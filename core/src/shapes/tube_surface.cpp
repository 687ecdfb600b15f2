#include "shapes/tube_surface.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "shapes/circle.h"

namespace vsplit {
namespace {

constexpr double kRound = 0.005;                              // what share of the radius vertices may be off the surface
constexpr double kStraight = 0.9999;                          // share of the run in one direction
constexpr int kSteps = 3;                                     // of a fit that begins closer than that
constexpr double kLeastSpan = 0.25 * std::numbers::pi / 180;  // of a face across the tube; one along its side spans nothing

/// The circle through the points that `flat` makes of a tube's vertices.
template <class Flat>
std::optional<Circle> circle_of(const TriangleMesh& mesh, const Tube& tube, const Flat& flat) {
    std::vector<Eigen::Vector2d> points;
    for (const std::uint32_t f : tube.faces) {
        for (const std::uint32_t v : mesh.faces[f]) points.push_back(flat(mesh.positions[v]));
    }
    return fit_circle(points);
}

/// The axis of a run that bends: sections along chords lie on a circle, if a smaller one.
std::optional<Axis> axis_of(const Tube& tube, const Run& run) {
    const Vec3 u = run.direction.unitOrthogonal(), v = run.direction.cross(u);
    std::vector<Eigen::Vector2d> points;
    for (const TubeSection& s : tube.sections)
        points.emplace_back((s.centre - run.centre).dot(u), (s.centre - run.centre).dot(v));
    const std::optional<Circle> circle = fit_circle(points);
    if (!circle) return {};
    return Axis{run.centre + circle->centre.x() * u + circle->centre.y() * v, run.direction};
}

std::optional<TubeSurface> fit_cylinder_to(const TriangleMesh& mesh, const Tube& tube, const Run& run) {
    const Vec3 u = run.direction.unitOrthogonal(), v = run.direction.cross(u);
    const std::optional<Circle> circle =
        circle_of(mesh, tube, [&](const Vec3& p) { return Eigen::Vector2d((p - run.centre).dot(u), (p - run.centre).dot(v)); });
    if (!circle) return {};
    const Vec3 point = run.centre + circle->centre.x() * u + circle->centre.y() * v;
    return TubeSurface{{point, run.direction}, 0, circle->radius, tube.sections.front().convex};
}

/// A step of Gauss-Newton on the distances of the tube's vertices: where the torus is, how it lies, and both its radii.
void refine(TubeSurface& torus, const TriangleMesh& mesh, const Tube& tube) {
    using Row = Eigen::Matrix<double, 8, 1>;
    Eigen::Matrix<double, 8, 8> normal = Eigen::Matrix<double, 8, 8>::Zero();
    Row right = Row::Zero();
    for (const std::uint32_t f : tube.faces) {
        for (const std::uint32_t v : mesh.faces[f]) {
            const Vec3 &p = mesh.positions[v], arm = p - torus.axis.point, out = torus.axis.radial(p).normalized();
            const Vec3 across = (arm - torus.out * out).normalized();
            Row row;
            row << across, arm.cross(-across) / torus.out, across.dot(out), 1;
            normal += row * row.transpose();
            right += row * (torus.flat(p).norm() - torus.radius);
        }
    }
    // A turn around the axis changes nothing: of the solutions the smallest.
    const Row step = normal.completeOrthogonalDecomposition().solve(right);
    torus.axis.point += step.head<3>();
    torus.axis.direction = (torus.axis.direction + Vec3(step.segment<3>(3)).cross(torus.axis.direction) / torus.out).normalized();
    torus.out += step[6];
    torus.radius += step[7];
}

std::optional<TubeSurface> fit_torus_to(const TriangleMesh& mesh, const Tube& tube, const Run& run) {
    const std::optional<Axis> axis = axis_of(tube, run);
    if (!axis) return {};
    const double near = axis->radial(tube.sections.front().centre).norm();
    const std::optional<Circle> circle =
        circle_of(mesh, tube, [&](const Vec3& p) { return Eigen::Vector2d(axis->radial(p).norm() - near, axis->along(p)); });
    if (!circle || !(near + circle->centre.x() > 0)) return {};
    const Vec3 point = axis->point + circle->centre.y() * axis->direction;
    TubeSurface torus{{point, axis->direction}, near + circle->centre.x(), circle->radius, tube.sections.front().convex};
    for (int i = 0; i < kSteps; ++i) refine(torus, mesh, tube);
    if (!(torus.out > 0 && torus.radius > 0) || !torus.axis.point.allFinite() || !torus.axis.direction.allFinite()) return {};
    return torus;
}

/// Whether a face bridges the tube and lies on it, not beside it with its corners on the border.
bool lies_on(const TubeSurface& surface, const TriangleMesh& mesh, const FaceNormals& normals, std::uint32_t f,
             double most_bend) {
    double least = 0, most = 0;
    Vec3 middle = Vec3::Zero();
    const Eigen::Vector2d first = surface.flat(mesh.positions[mesh.faces[f][0]]);
    for (const std::uint32_t v : mesh.faces[f]) {
        const Vec3& p = mesh.positions[v];
        if (surface.off(p) > kRound) return false;
        const Eigen::Vector2d here = surface.flat(p);
        const double turn = std::atan2(first.x() * here.y() - first.y() * here.x(), first.dot(here));
        least = std::min(least, turn);
        most = std::max(most, turn);
        middle += p / 3;
    }
    return most - least > kLeastSpan && surface.normal_at(middle).dot(normals.normals[f]) > std::cos(most_bend);
}

}  // namespace

Run run_of(const Tube& tube) {
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    Vec3 centre = Vec3::Zero();
    double length = 0;
    for (const TubeSection& s : tube.sections) {
        spread += s.length * s.along * s.along.transpose();
        centre += s.length * s.centre;
        length += s.length;
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(spread);
    const bool straight = solver.eigenvalues()[2] > kStraight * length;
    return {solver.eigenvectors().col(straight ? 2 : 0), centre / length, straight};
}

Eigen::Vector2d TubeSurface::flat(const Vec3& p) const {
    if (out > 0) return {axis.radial(p).norm() - out, axis.along(p)};
    const Vec3 u = axis.direction.unitOrthogonal();
    return {(p - axis.point).dot(u), (p - axis.point).dot(axis.direction.cross(u))};
}

double TubeSurface::off(const Vec3& p) const { return std::abs(flat(p).norm() - radius) / radius; }

Vec3 TubeSurface::normal_at(const Vec3& p) const {
    const Vec3 arm = axis.radial(p);
    const Vec3 outward = out > 0 ? Vec3(p - axis.point - out * arm.normalized()) : arm;
    return (convex ? 1 : -1) * outward.normalized();
}

Vec3 TubeSurface::along_at(const Vec3& p) const {
    return out > 0 ? Vec3(axis.direction.cross(axis.radial(p)).normalized()) : axis.direction;
}

std::optional<TubeSurface> fit_surface(const TriangleMesh& mesh, const Tube& tube) {
    const Run run = run_of(tube);
    std::optional<TubeSurface> surface = run.straight ? fit_cylinder_to(mesh, tube, run) : fit_torus_to(mesh, tube, run);
    if (!surface) return {};
    for (const std::uint32_t f : tube.faces) {
        for (const std::uint32_t v : mesh.faces[f]) {
            if (surface->off(mesh.positions[v]) > kRound) return {};
        }
    }
    return surface;
}

std::vector<std::uint32_t> faces_on(const TubeSurface& surface, const TriangleMesh& mesh, const FaceNormals& normals,
                                    const std::vector<HalfEdge>& twin, const Tube& tube, double most_bend) {
    std::set<std::uint32_t> found(tube.faces.begin(), tube.faces.end());
    const auto is_enclosed = [&](std::uint32_t f) {  // a sliver may look elsewhere
        const HalfEdge h = 3 * f;
        return found.count(face_of(twin[h])) + found.count(face_of(twin[h + 1])) + found.count(face_of(twin[h + 2])) == 3;
    };
    std::vector<std::uint32_t> open = tube.faces;
    while (!open.empty()) {
        const std::uint32_t f = open.back();
        open.pop_back();
        for (HalfEdge h = 3 * f; h < 3 * f + 3; ++h) {
            const std::uint32_t beside = face_of(twin[h]);
            if (found.count(beside) > 0) continue;
            if (!lies_on(surface, mesh, normals, beside, most_bend) && !is_enclosed(beside)) continue;
            found.insert(beside);
            open.push_back(beside);
        }
    }
    return {found.begin(), found.end()};
}

}  // namespace vsplit
