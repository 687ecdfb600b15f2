#include "quality/distance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>

namespace vsplit::bench {
namespace {

using Corners = std::array<Vec3, 3>;

Vec3 closest_on_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
    const Vec3 ab = b - a;
    const double length = ab.squaredNorm();
    return length > 0 ? Vec3(a + ab * std::clamp((p - a).dot(ab) / length, 0.0, 1.0)) : a;
}

/// Above the inside of the triangle the foot on its plane, else the nearest point of its sides; a triangle without area has only
/// sides.
double squared_distance(const Vec3& p, const Corners& t) {
    double best = std::numeric_limits<double>::infinity();
    const Vec3 normal = (t[1] - t[0]).cross(t[2] - t[0]);
    bool inside = normal.squaredNorm() > 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3& a = t[i];
        const Vec3& b = t[(i + 1) % 3];
        best = std::min(best, (p - closest_on_segment(p, a, b)).squaredNorm());
        inside = inside && normal.cross(b - a).dot(p - a) > 0;
    }
    if (!inside) return best;
    const double height = normal.dot(p - t[0]);
    return std::min(best, height * height / normal.squaredNorm());
}

}  // namespace

/// Boxes halved at the median of their longest side, four triangles a leaf.
class Distance::Tree {
public:
    explicit Tree(std::vector<Corners> triangles) : triangles_(std::move(triangles)) {
        if (!triangles_.empty()) build(0, static_cast<std::uint32_t>(triangles_.size()));
    }

    [[nodiscard]] double nearest(const Vec3& p, double enough) const {
        double best = std::numeric_limits<double>::infinity();
        if (!nodes_.empty()) visit(0, p, enough * enough, best);
        return std::sqrt(best);
    }

private:
    static constexpr std::uint32_t kLeaf = 4;

    struct Node {
        Vec3 min = Vec3::Constant(std::numeric_limits<double>::infinity());
        Vec3 max = -min;
        std::uint32_t first = 0;
        std::uint32_t last = 0;
        std::uint32_t right = 0;  ///< 0 in a leaf; the left child follows its parent

        [[nodiscard]] double squared_distance(const Vec3& p) const {
            return (min - p).cwiseMax(p - max).cwiseMax(0.0).squaredNorm();
        }
    };

    std::uint32_t build(std::uint32_t first, std::uint32_t last) {
        const auto index = static_cast<std::uint32_t>(nodes_.size());
        nodes_.emplace_back();
        Node node;
        node.first = first;
        node.last = last;
        for (std::uint32_t i = first; i < last; ++i) {
            for (const Vec3& corner : triangles_[i]) {
                node.min = node.min.cwiseMin(corner);
                node.max = node.max.cwiseMax(corner);
            }
        }
        if (last - first > kLeaf) {
            int axis = 0;
            (node.max - node.min).maxCoeff(&axis);
            const std::uint32_t middle = first + (last - first) / 2;
            std::nth_element(triangles_.begin() + first, triangles_.begin() + middle, triangles_.begin() + last,
                             [axis](const Corners& l, const Corners& r) {
                                 return l[0][axis] + l[1][axis] + l[2][axis] < r[0][axis] + r[1][axis] + r[2][axis];
                             });
            build(first, middle);
            node.right = build(middle, last);
        }
        nodes_[index] = node;
        return index;
    }

    void visit(std::uint32_t index, const Vec3& p, double enough, double& best) const {
        const Node& node = nodes_[index];
        if (best <= enough || node.squared_distance(p) >= best) return;
        if (node.right == 0) {
            for (std::uint32_t i = node.first; i < node.last; ++i) best = std::min(best, squared_distance(p, triangles_[i]));
            return;
        }
        std::uint32_t near = index + 1;
        std::uint32_t far = node.right;
        if (nodes_[far].squared_distance(p) < nodes_[near].squared_distance(p)) std::swap(near, far);
        visit(near, p, enough, best);
        visit(far, p, enough, best);
    }

    std::vector<Corners> triangles_;
    std::vector<Node> nodes_;
};

Distance::Distance(const TriangleMesh& surface) {
    std::vector<Corners> triangles;
    for (const Triangle& t : surface.faces) {
        triangles.push_back({surface.positions[t[0]], surface.positions[t[1]], surface.positions[t[2]]});
    }
    tree_ = std::make_unique<const Tree>(std::move(triangles));
}

Distance::Distance(const std::vector<Segment>& segments) {
    std::vector<Corners> triangles;
    for (const Segment& s : segments) triangles.push_back({s[0], s[1], s[1]});
    tree_ = std::make_unique<const Tree>(std::move(triangles));
}

Distance::~Distance() = default;

double Distance::distance(const Vec3& point, double enough) const { return tree_->nearest(point, enough); }

}  // namespace vsplit::bench
