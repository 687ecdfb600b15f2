#include "quality/crease_gap.h"

#include <Eigen/Geometry>
#include <cmath>

namespace vsplit {
namespace {

using Vec2 = Eigen::Vector2d;

constexpr int kMostFaces = 64;

/// Where the third corner of a face lies beside its half-edge h, which is laid out from `a` to `b`: on the left.
Vec2 lay_out(const TriangleMesh& mesh, HalfEdge h, const Vec2& a, const Vec2& b) {
    const Vec3& start = mesh.positions[origin(mesh, h)];
    const Vec3 side = mesh.positions[origin(mesh, next(h))] - start;
    const Vec3 other = mesh.positions[origin(mesh, prev(h))] - start;
    const double square = side.squaredNorm();
    if (!(square > 0)) return a;
    const Vec2 along = b - a;
    return a + other.dot(side) / square * along + other.cross(side).norm() / square * Vec2(-along.y(), along.x());
}

/// A half-edge whose face is laid out on its left.
struct Crossing {
    HalfEdge edge = kNone;
    Vec2 from = Vec2::Zero();
    Vec2 to = Vec2::Zero();

    /// Which of a face's other two sides the line x = const leaves by; `third` is the corner opposite to this edge.
    [[nodiscard]] Crossing leave_face(HalfEdge entry, const Vec2& third, double x) const {
        // The entry runs from `to` to `from`.
        const bool by_next = (from.x() <= x) != (third.x() <= x);
        return by_next ? Crossing{next(entry), from, third} : Crossing{prev(entry), third, to};
    }

    [[nodiscard]] double height_at(double x) const {
        const double width = to.x() - from.x();
        return width == 0 ? from.y() : from.y() + (x - from.x()) / width * (to.y() - from.y());
    }
};

/// How far the line x = const goes from height y beyond an edge until it meets a crease.
std::optional<double> way_to_crease(const TriangleMesh& mesh, const CreaseMarks& marks, Crossing at, const Vec2& start,
                                    double reach) {
    for (int faces = 0; faces < kMostFaces; ++faces) {
        const double way = std::abs(at.height_at(start.x()) - start.y());
        if (!(way <= reach)) return std::nullopt;
        const HalfEdge entry = marks.twin(at.edge);
        if (entry == kNone || marks.marked(at.edge)) return way;
        at = at.leave_face(entry, lay_out(mesh, entry, at.to, at.from), start.x());
    }
    return std::nullopt;
}

}  // namespace

std::optional<double> crease_gap(const TriangleMesh& mesh, const CreaseMarks& marks, HalfEdge longest, double reach) {
    const Vec2 a = Vec2::Zero();
    const Vec2 b((mesh.positions[origin(mesh, next(longest))] - mesh.positions[origin(mesh, longest)]).norm(), 0);
    const Vec2 c = lay_out(mesh, longest, a, b);
    const Vec2 start = (a + b + c) / 3;
    const Crossing below{longest, a, b};
    const std::optional<double> down = way_to_crease(mesh, marks, below, start, reach);
    if (!down) return std::nullopt;
    const Crossing above = start.x() >= c.x() ? Crossing{next(longest), b, c} : Crossing{prev(longest), c, a};
    const std::optional<double> up = way_to_crease(mesh, marks, above, start, reach - *down);
    return up ? std::optional(*up + *down) : std::nullopt;
}

}  // namespace vsplit
