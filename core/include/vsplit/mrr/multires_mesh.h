#pragma once

#include <cstdint>
#include <vector>

#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// Undoes one edge collapse (i, j) -> k ([Date05] 2.1, [Hoppe96]): the vertex at corner `anchor` splits in two.
///
/// A corner is 3 * face + (0, 1 or 2); it names a vertex of a face, and the half-edge that leaves it along the face.
/// Let v be the vertex at corner `anchor`. Counter-clockwise around v, the face of `anchor` and those after it, `steps` in
/// all, go over to a new vertex w. Split number s (from 0) of a representation whose base mesh has n0 vertices and f0 faces
/// makes the vertex w = n0 + s and the faces f0 + 2s = (v, w, e) and f0 + 2s + 1 = (w, v, b), where b is the ring vertex at
/// which the fan that moves begins and e the one at which it ends. Afterwards v lies at `kept` and w at `added`.
struct VertexSplit {
    std::uint32_t anchor = 0;
    std::uint32_t steps = 0;  ///< 1 .. valence(v) - 1
    Vec3 kept = Vec3::Zero();
    Vec3 added = Vec3::Zero();

    friend bool operator==(const VertexSplit&, const VertexSplit&) = default;
};

/// The multiresolution representation (MRR): the coarsest mesh and the splits that lead to the finest, in order.
/// Level s has the base mesh's faces plus 2s.
struct MultiresMesh {
    TriangleMesh base;
    std::vector<VertexSplit> splits;

    [[nodiscard]] std::uint32_t faces_min() const { return base.face_count(); }
    [[nodiscard]] std::uint32_t faces_max() const { return faces_at(splits.size()); }
    [[nodiscard]] std::uint32_t faces_at(std::size_t level) const {
        return base.face_count() + 2 * static_cast<std::uint32_t>(level);
    }

    /// The finest level with at most `faces` faces, or the base where even that has more; the last level where none has as many.
    [[nodiscard]] std::size_t level_for(std::uint32_t faces) const;

    friend bool operator==(const MultiresMesh&, const MultiresMesh&) = default;
};

}  // namespace vsplit
