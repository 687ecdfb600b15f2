#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "vsplit/base/expected.h"
#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// What a weld changed, and what a reader dropped beside.
struct WeldCounts {
    std::uint32_t merged_vertices = 0;  ///< vertices that became another one
    std::uint32_t near_vertices = 0;    ///< those of them that were not equal to it
    std::uint32_t unused_vertices = 0;  ///< vertices no face used, dropped
    std::uint32_t collapsed_faces = 0;  ///< faces with two equal corners after merging, dropped: they have no area and no inside
    std::vector<Vec3> near_places{};    ///< where the first Finding::kExamples of near_vertices were
    std::vector<Vec3> collapsed_places{};          ///< where the first of collapsed_faces were
    std::vector<std::string> unused_sets{};        ///< names of a file's sets that no face is in, dropped
    std::vector<std::uint32_t> emptied_regions{};  ///< regions in no set whose faces all collapsed
};

/// Merges vertices that are equal (`tolerance` 0; -0 equals 0), or within `tolerance` (length, model units) of a vertex that
/// came earlier, and drops what that leaves without use. Vertices keep the order of their first appearance, faces theirs.
///
/// \pre coordinates are finite.
/// \return INVALID_OPTION for a negative, NaN or infinite tolerance.
/// Complexity: O(n) expected for tolerance 0 or well below the vertex spacing. Memory: 20 bytes a vertex.
[[nodiscard]] Expected<WeldCounts> weld(TriangleMesh& mesh, double tolerance);

}  // namespace vsplit
