#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "simplify/half_edge_mesh.h"
#include "vsplit/mrr/multires_mesh.h"

namespace vsplit {

/// Every collapse in order with the edits after it, and the MRR they make when read backwards. What was edited before the first
/// collapse is not kept: the finest level is the mesh as it stands at the first collapse.
class CollapseLog {
public:
    /// Makes room for so many collapses; memory is taken as it is used.
    void reserve(std::size_t collapses) { entries_.reserve(collapses); }

    /// Call before the collapse, which leaves the vertex at `position`, while the star still stands and all edits of the step
    /// before are made. O(moves since).
    void record(const HalfEdgeMesh& mesh, const EdgeStar& star, const Vec3& position);

    /// The edge of h was turned counter-clockwise: HalfEdgeMesh::flip(h). O(1).
    void record_flip(HalfEdge h);

    /// Call before vertex v of `mesh` moves. Of several moves between two collapses the net one is kept: none where a vertex
    /// ends where it began, nor for the vertex that the collapse made, which the split puts elsewhere anyway. O(1).
    void record_move(const HalfEdgeMesh& mesh, std::uint32_t v);

    /// Number of collapses.
    [[nodiscard]] std::size_t size() const { return before_ + entries_.size(); }

    void clear() { *this = {}; }

    /// What comes next are collapses: moves in vain are dropped, which could not be told from others once vertices go.
    void end_step(const HalfEdgeMesh& mesh) { keep_net_moves(mesh); }

    /// A log of what comes next in a part of `mesh`, kept beside those of other parts. `append` them before this one is used
    /// again.
    [[nodiscard]] CollapseLog fork(const HalfEdgeMesh& mesh);

    /// As if what a fork tells had been recorded here. \pre what parts did does not depend on the order they come in.
    void append(CollapseLog part);

    /// Numbers what is left of `mesh` as the base mesh, each vertex and pair of faces that went as the
    /// split that brings them back, and turns faces as VertexSplit wants them. For each collapse, newest first, come the flips
    /// after it, last first, the moves, each to where its vertex lay before, and the split. No ghost of `mesh` was collapsed
    /// or moved. O(faces + records log(records)). Empties the log.
    ///
    /// What is free is chosen so that records and base mesh take few bytes: of the two vertices of a split the one with fewer
    /// edges is the new one, of two with as many the one whose fan begins at the nearer end; moves between two splits go by
    /// vertex, and the base mesh is numbered as walk_faces goes.
    [[nodiscard]] MultiresMesh build(const HalfEdgeMesh& mesh);

private:
    struct Entry {
        HalfEdge ij = 0;  // its face comes back as (v, w, e)
        HalfEdge ji = 0;  // its face comes back as (w, v, b)
        HalfEdge anchor = 0;
        std::uint16_t steps = 0;        // of the split; valences are at most kValenceCeiling
        bool is_gone_new = false;       // the vertex of ji comes back, which the mesh let go; else that of ij
        bool is_at_border = false;      // e or b is a ghost
        Vec3 stayed_at = Vec3::Zero();  // of the vertex that stayed; the other one lies where it lay
    };

    /// How many flips and moves there were before a collapse.
    struct Edits {
        std::uint32_t flips = 0;
        std::uint32_t moves = 0;
    };
    /// Of the last collapse.
    [[nodiscard]] Edits last_edits() const { return edits_.empty() ? Edits{} : edits_.back(); }

    void keep_net_moves(const HalfEdgeMesh& mesh);

    std::vector<Entry> entries_;
    std::uint32_t stayed_ = kNone;  // the vertex that the last collapse left
    std::vector<Edits> edits_;      // of the last collapses; there were none before the others
    std::vector<HalfEdge> flips_;
    std::vector<VertexMove> moves_;                         // positions are those before
    std::shared_ptr<std::vector<std::uint32_t>> moved_in_;  // per vertex: collapses made when it was moved last
    std::size_t before_ = 0;                                // of a fork: collapses of what it was forked from
};

}  // namespace vsplit
