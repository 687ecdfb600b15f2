#pragma once

#include <cstdint>
#include <map>
#include <optional>
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

/// The faces of each region, ascending.
using FacesOfRegions = std::map<std::uint32_t, std::vector<std::uint32_t>>;

/// O(faces log regions). \pre the mesh has regions.
[[nodiscard]] FacesOfRegions faces_of_regions(const TriangleMesh& mesh);

/// The faces of a set, ascending. O(result log result + regions of the set).
[[nodiscard]] std::vector<std::uint32_t> faces_of_set(const FaceSet& set, const FacesOfRegions& of_regions);

/// The mesh with its regions numbered from 1 in ascending order, 0 aside, where one is over `largest`, for formats that have no
/// room for it; none where all fit. Of more regions than that the last become 0. O(faces log regions).
[[nodiscard]] std::optional<TriangleMesh> with_regions_up_to(std::uint32_t largest, const TriangleMesh& mesh);

/// The mesh's sets that have faces: others, as of a hole that was filled, are in no file. O(faces log regions).
[[nodiscard]] std::vector<FaceSet> sets_with_faces(const TriangleMesh& mesh);

/// Those that have faces, and of regions that are in none a set each, with names of letters, digits, '_', '-' and '.' that are
/// different in any case and begin with a letter. Faces in region 0 that are in no set of the mesh are in none.
[[nodiscard]] std::vector<FaceSet> sets_for_solvers(const TriangleMesh& mesh);

}  // namespace vsplit
