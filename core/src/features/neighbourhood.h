#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "mesh/half_edges.h"

namespace vsplit {

/// The corners (half-edges) at each vertex, in order. O(faces).
class VertexCorners {
public:
    explicit VertexCorners(const TriangleMesh& mesh);

    [[nodiscard]] std::span<const HalfEdge> at(std::uint32_t vertex) const {
        return {corners_.data() + first_[vertex], corners_.data() + first_[vertex + 1]};
    }

private:
    std::vector<std::uint32_t> first_;
    std::vector<HalfEdge> corners_;
};

/// Distances along edges from a few vertices, nearest first (Dijkstra). One a thread; searches leave nothing behind.
class EdgePaths {
public:
    struct Reached {
        double distance = 0;
        std::uint32_t vertex = 0;
    };

    EdgePaths(const TriangleMesh& mesh, const VertexCorners& corners)
        : mesh_(mesh), corners_(corners), distance_(mesh.positions.size(), kFar) {}

    /// Where edges are much shorter than the mesh's mean a radius says nothing: no search goes on beyond so many vertices. Six
    /// rings of a regular mesh have 127.
    static constexpr std::size_t kMost = 128;

    /// The vertices within `radius` of `sources`, the nearest kMost of them, with their distances, those of the sources 0; valid
    /// until the next search.
    std::span<const Reached> search(std::span<const std::uint32_t> sources, double radius);

    /// Of the last search; more than its radius for what it did not reach.
    [[nodiscard]] double distance(std::uint32_t vertex) const { return distance_[vertex]; }

private:
    static constexpr double kFar = 1e300;

    void offer(std::uint32_t vertex, double distance);

    const TriangleMesh& mesh_;
    const VertexCorners& corners_;
    std::vector<double> distance_;
    std::vector<Reached> heap_;
    std::vector<Reached> reached_;
    std::vector<std::uint32_t> touched_;
    double radius_ = 0;
};

}  // namespace vsplit
