#pragma once

#include <cstdint>
#include <vector>

#include "simplify/half_edge_mesh.h"
#include "vsplit/mrr/multires_mesh.h"

namespace vsplit {

/// Every collapse in order, and the MRR they make when read backwards.
class CollapseLog {
public:
    /// Call before the collapse, while the star still stands.
    void record(const HalfEdgeMesh& mesh, const EdgeStar& star);

    [[nodiscard]] std::size_t size() const { return entries_.size(); }

    /// Numbers what is left of `mesh` as the base mesh (in the order it had), each vertex and pair of faces that went as the
    /// split that brings them back, and turns faces as VertexSplit wants them. O(faces). Empties the log.
    [[nodiscard]] MultiresMesh build(const HalfEdgeMesh& mesh);

private:
    struct Entry {
        HalfEdge ij = 0;  // its face comes back as (v, w, e)
        HalfEdge ji = 0;  // its face comes back as (w, v, b)
        HalfEdge anchor = 0;
        std::uint32_t removed = 0;
        std::uint32_t steps = 0;
        Vec3 kept_at = Vec3::Zero();
        Vec3 removed_at = Vec3::Zero();
    };
    std::vector<Entry> entries_;
};

}  // namespace vsplit
