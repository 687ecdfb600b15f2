#pragma once

#include <string>
#include <vector>

#include "vsplit/io/mesh_format.h"
#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// Names of the mesh's sets with faces that a file of this format does not have: it has no names, or one a region. In the mesh's
/// order. O(faces log regions).
[[nodiscard]] std::vector<std::string> sets_left_out(const TriangleMesh& mesh, MeshFormat format);

/// How coarse coordinates get, and what that does.
struct Rounding {
    double step = 0;           ///< length: between the largest coordinate and its neighbour in the file; 0 where doubles are kept
    double shortest_edge = 0;  ///< length: of the mesh, those without length aside

    /// Faces change shape where a step is more than a hundredth of an edge.
    [[nodiscard]] bool is_coarse() const { return step > 0.01 * shortest_edge; }
};

/// O(faces) for the formats of single precision (STL), else O(1).
[[nodiscard]] Rounding rounding_of(const TriangleMesh& mesh, MeshFormat format);

}  // namespace vsplit
