#pragma once

#include <cstdint>
#include <vector>

#include "vsplit/mesh/triangle_mesh.h"
#include "vsplit/mrr/multires_mesh.h"

namespace vsplit {

/// The options with the regions of `mesh`, where they name none of their own and the mesh has some: their borders are creases.
template <class Options>
[[nodiscard]] Options with_regions(const TriangleMesh& mesh, Options options) {
    if (options.regions.empty()) options.regions = mesh.regions;
    return options;
}

/// Gives each face of the finest resolution the region of the source there. Faces keep their numbers from one resolution to the
/// next, and stay on their side of a border, which is a crease: so all resolutions have them. Nothing without regions.
/// O(faces log faces), in parallel. \pre one region a face of `source`.
void carry_regions(const TriangleMesh& source, const std::vector<std::uint32_t>& regions, MultiresMesh& mrr);

}  // namespace vsplit
