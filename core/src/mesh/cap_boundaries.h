#pragma once

#include <algorithm>
#include <cstdint>

#include "vsplit/base/expected.h"
#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// A mesh closed by ghosts: vertices 0 .. ghosts - 1 are one a boundary loop, at its centroid, joined to each of its edges.
struct CappedMesh {
    TriangleMesh mesh;         ///< ghosts, then the vertices there were; the faces there were, then ghost faces
    std::uint32_t ghosts = 0;  ///< number of boundary loops
};

/// Closes every boundary loop by a ghost vertex. A closed mesh comes back as it is, with no ghosts. Loops are numbered by the
/// first of their edges in order of faces.
/// \return EMPTY_INPUT, or NON_MANIFOLD naming the first edges or vertices at fault: an edge with more than two faces or faces
/// that disagree, a vertex at which two fans of faces, so also two parts of the boundary, meet. O(faces log faces).
[[nodiscard]] Expected<CappedMesh> cap_boundaries(TriangleMesh mesh);

/// The same for who knows that `mesh` is manifold. \pre require_manifold finds nothing. O(faces).
[[nodiscard]] CappedMesh cap_manifold(TriangleMesh mesh);

[[nodiscard]] inline bool touches_ghost(const Triangle& face, std::uint32_t ghosts) {
    return std::min({face[0], face[1], face[2]}) < ghosts;
}

/// Undoes cap_boundaries, on whatever has become of the complex: drops the first `ghosts` vertices and the faces that touch
/// them. O(faces).
[[nodiscard]] TriangleMesh visible_mesh(TriangleMesh complex, std::uint32_t ghosts);

}  // namespace vsplit
