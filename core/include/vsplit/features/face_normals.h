#pragma once

#include <vector>

#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// Unit normal of each face. A sliver so thin that the rounding of its coordinates decides where it faces takes the normal of
/// the neighbour across its longest edge instead (or of another neighbour, where that one is a sliver too), so that CAD slivers
/// neither raise false creases nor give false planes to the quadrics.
struct FaceNormals {
    std::vector<Vec3> normals;   ///< one a face; zero only where a whole component has no area
    std::vector<bool> reliable;  ///< false where the normal was borrowed
};

/// \pre `mesh` is manifold. O(faces).
[[nodiscard]] FaceNormals face_normals(const TriangleMesh& mesh);

}  // namespace vsplit
