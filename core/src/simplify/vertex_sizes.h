#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "simplify/half_edge_mesh.h"
#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// How large faces are to be at each vertex of the mesh being simplified; without sizes everything here is neutral.
///
/// A vertex that a collapse or a move brings elsewhere takes the sizes there from those of its neighbours. What may come of that
/// over many steps is left a margin, and the result is measured (`find_oversized`).
class VertexSizes {
public:
    VertexSizes() = default;
    /// `allowed`: one a vertex, length or infinity. `usual`: what is wanted where more is allowed. `binding`: longer edges are
    /// refused; else sizes only say how large a face is against what is wanted.
    VertexSizes(std::vector<double> allowed, double usual, bool binding)
        : allowed_(std::move(allowed)), usual_(usual), binding_(binding) {}

    [[nodiscard]] bool given() const { return !allowed_.empty(); }
    [[nodiscard]] bool binding() const { return binding_; }
    [[nodiscard]] double allowed(std::uint32_t v) const { return allowed_[v]; }
    void put(std::uint32_t v, double allowed) { allowed_[v] = allowed; }

    /// A length against what is wanted at three vertices; the length itself without sizes.
    [[nodiscard]] double relative(double length, std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
        return given() ? 3 * length / (wanted(a) + wanted(b) + wanted(c)) : length;
    }

    /// Whether a new edge may be so long where these sizes are allowed.
    [[nodiscard]] static bool fits(double length, double allowed_a, double allowed_b) {
        constexpr double kMargin = 0.95;
        return length <= kMargin * std::min(allowed_a, allowed_b);
    }
    [[nodiscard]] bool admits(double length, std::uint32_t a, std::uint32_t b) const {
        return !binding_ || fits(length, allowed_[a], allowed_[b]);
    }

    /// What is allowed at a place between two vertices: linear along their edge.
    [[nodiscard]] double between(const HalfEdgeMesh& mesh, std::uint32_t i, std::uint32_t j, const Vec3& place) const {
        const Vec3 along = mesh.position(j) - mesh.position(i);
        const double square = along.squaredNorm();
        const double share = square > 0 ? std::clamp((place - mesh.position(i)).dot(along) / square, 0.0, 1.0) : 0;
        return share == 0 ? allowed_[i] : share == 1 ? allowed_[j] : (1 - share) * allowed_[i] + share * allowed_[j];
    }

    /// What is allowed where v moves to: what lies nearest counts most.
    [[nodiscard]] double around(const HalfEdgeMesh& mesh, std::uint32_t v, const Vec3& place) const {
        double sum = 0, weights = 0;
        const auto add = [&](std::uint32_t u) {
            const double weight = 1 / std::max((mesh.position(u) - place).squaredNorm(), std::numeric_limits<double>::min());
            sum += weight * allowed_[u];
            weights += weight;
        };
        add(v);
        mesh.for_each_outgoing(v, [&](HalfEdge h) { add(mesh.target(h)); });
        return sum / weights;
    }

private:
    [[nodiscard]] double wanted(std::uint32_t v) const { return std::min(allowed_[v], usual_); }

    std::vector<double> allowed_;
    double usual_ = std::numeric_limits<double>::infinity();
    bool binding_ = false;
};

}  // namespace vsplit
