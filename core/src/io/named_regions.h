#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// A region of a mesh as files name it.
struct NamedRegion {
    std::uint32_t region = 0;
    std::string name;  ///< of the first set of this region alone, else "region_<id>"
    bool has_name = false;
    std::vector<std::uint32_t> faces;
};

/// The regions that have faces, ascending. A mesh without regions is one, 0, named "all". O(faces log regions).
[[nodiscard]] std::vector<NamedRegion> named_regions(const TriangleMesh& mesh);

/// The mesh's sets, and of regions that are in none a set each, with names of letters, digits, '_', '-' and '.' that are
/// different in any case and begin with a letter. Faces in region 0 that are in no set of the mesh are in none.
[[nodiscard]] std::vector<FaceSet> sets_for_solvers(const TriangleMesh& mesh);

}  // namespace vsplit
