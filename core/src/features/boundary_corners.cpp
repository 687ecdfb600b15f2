#include "features/boundary_corners.h"

#include <cmath>
#include <numbers>

#include "mesh/boundary_loops.h"

namespace vsplit {
namespace {

/// A closed polygon in space.
class Loop {
public:
    Loop(const TriangleMesh& mesh, const std::vector<HalfEdge>& loop) {
        for (const HalfEdge h : loop) points_.push_back(mesh.positions[origin(mesh, h)]);
    }

    /// Whether the way from `reach` before point n to it and on turns by more than the angle of this cosine.
    [[nodiscard]] bool turns(std::size_t n, double reach, double cosine) const {
        const Vec3 in = points_[n] - walk(n, reach, points_.size() - 1);
        const Vec3 out = walk(n, reach, 1) - points_[n];
        return in.dot(out) < cosine * in.norm() * out.norm();
    }

private:
    /// The point `reach` along the loop, half of it at most, in steps of `step` points; at least one step.
    [[nodiscard]] Vec3 walk(std::size_t n, double reach, std::size_t step) const {
        double left = reach;
        for (std::size_t steps = 0;; ++steps) {
            const std::size_t after = (n + step) % points_.size();
            const Vec3 way = points_[after] - points_[n];
            const double length = way.norm();
            if (steps > 0 && length >= left) return points_[n] + way * (left / length);
            if (length >= left || 2 * steps >= points_.size()) return points_[after];
            left -= length;
            n = after;
        }
    }

    std::vector<Vec3> points_;
};

}  // namespace

std::vector<std::uint32_t> boundary_corners(const TriangleMesh& mesh, const BoundaryCornerOptions& options) {
    const double cosine = std::cos(options.angle * std::numbers::pi / 180);
    std::vector<std::uint32_t> corners;
    for (const std::vector<HalfEdge>& half_edges : boundary_loops(mesh)) {
        const Loop loop(mesh, half_edges);
        for (std::size_t n = 0; n < half_edges.size(); ++n) {
            if (loop.turns(n, 0, cosine) && loop.turns(n, options.reach, cosine)) {
                corners.push_back(origin(mesh, half_edges[n]));
            }
        }
    }
    return corners;
}

}  // namespace vsplit
