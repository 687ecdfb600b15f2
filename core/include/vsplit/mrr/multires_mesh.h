#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "vsplit/mesh/triangle_mesh.h"
#include "vsplit/mrr/records.h"

namespace vsplit {

/// The multiresolution representation (MRR): the coarsest mesh and the records that lead to the finest, in order.
///
/// Level s is the mesh right after split number s - 1; level 0 is the base mesh. Between two splits stand the edits (flips and
/// moves) that lead from level s to the mesh that split number s is applied to; after the last split there are none.
///
/// A mesh with open boundaries is kept as a closed one, its complex: a ghost vertex per boundary loop, joined to the loop's
/// edges. The first `ghosts` vertices of the base are ghosts. What a user sees of a level, and what all numbers of faces here
/// count, is the visible mesh: without faces that touch a ghost, vertex v of the complex as vertex v - ghosts.
struct MultiresMesh {
    TriangleMesh base;  ///< closed 2-manifold, ghost faces included
    RecordList records;
    std::uint32_t ghosts = 0;                       ///< 0: the mesh is closed
    std::uint32_t ghost_faces = 0;                  ///< faces of the base that touch a ghost; count_ghost_faces(base, ghosts)
    std::vector<std::uint32_t> border_splits = {};  ///< splits, ascending, that add one visible face; all others add two
    /// Of each face of the finest complex its region, 0 where it touches a ghost; empty: none. A face keeps its number from the
    /// level on at which it first is there, and its region: those of a level are the first so many.
    std::vector<std::uint32_t> regions = {};
    std::vector<FaceSet> sets = {};  ///< as in TriangleMesh

    /// Number of splits.
    [[nodiscard]] std::size_t levels() const { return records.splits().size(); }

    [[nodiscard]] std::uint32_t faces_min() const { return base.face_count() - ghost_faces; }
    [[nodiscard]] std::uint32_t faces_max() const { return faces_at(levels()); }
    /// O(log(border_splits)).
    [[nodiscard]] std::uint32_t faces_at(std::size_t level) const;

    /// The finest level with at most `faces` faces, or the base where even that has more; the last level where none has as many.
    /// O(log(levels)).
    [[nodiscard]] std::size_t level_for(std::uint32_t faces) const;

    /// How many records lead from the base to a level. \pre level <= levels(). O(log(records)).
    [[nodiscard]] std::size_t record_of_level(std::size_t level) const;

    friend bool operator==(const MultiresMesh&, const MultiresMesh&) = default;
};

/// Faces of `complex` that touch one of its first `ghosts` vertices. O(faces), O(1) without ghosts.
[[nodiscard]] std::uint32_t count_ghost_faces(const TriangleMesh& complex, std::uint32_t ghosts);

}  // namespace vsplit
