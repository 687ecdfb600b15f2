#pragma once

#include <cstdint>
#include <vector>

#include "mesh/half_edges.h"
#include "vsplit/features/sharp_edges.h"

namespace vsplit {

/// Which edges of a mesh are creases, and what they weigh.
class CreaseMarks {
public:
    explicit CreaseMarks(const TriangleMesh& mesh);

    /// Of several marks the heaviest counts.
    void mark(HalfEdge h, double weight);

    /// Marks the edges that `edges` names by their vertices. \pre they exist.
    void mark(const std::vector<SharpEdge>& edges);

    [[nodiscard]] bool marked(HalfEdge h) const { return weights_[edge_of(h)] >= 0; }
    [[nodiscard]] double weight(HalfEdge h) const { return weights_[edge_of(h)]; }
    [[nodiscard]] HalfEdge twin(HalfEdge h) const { return twins_[h]; }
    [[nodiscard]] HalfEdge half_edge_count() const { return static_cast<HalfEdge>(twins_.size()); }
    /// The number an edge goes by: the smaller of its half-edges.
    [[nodiscard]] HalfEdge edge_of(HalfEdge h) const { return twins_[h] < h ? twins_[h] : h; }

    /// In order of their first half-edge.
    [[nodiscard]] std::vector<SharpEdge> edges() const;

private:
    static constexpr double kUnmarked = -1;

    const TriangleMesh& mesh_;
    std::vector<HalfEdge> twins_;
    std::vector<double> weights_;  // at the edges' numbers
};

}  // namespace vsplit
