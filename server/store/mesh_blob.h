#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "store/blob_store.h"
#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit::store {

/// The arrays of a mesh as they lie in memory: 24 bytes ("VSPLMESH", vertices, faces and faces with a region as 32 bits each, 4
/// bytes 0), then positions (float64), faces and regions (32 bits), little-endian. Names of regions are not in it.
class MeshBlob {
public:
    /// \pre `mesh` outlives this. O(1).
    explicit MeshBlob(const TriangleMesh& mesh);

    /// To be kept, one after the other.
    [[nodiscard]] const std::array<Bytes, 4>& parts() const { return parts_; }

private:
    std::array<std::uint32_t, 6> header_;
    std::array<Bytes, 4> parts_;
};

/// \return CORRUPT for sizes that do not fit the bytes, and for an index beyond the vertices. O(bytes).
[[nodiscard]] Expected<TriangleMesh> read_mesh_blob(Bytes bytes);

}  // namespace vsplit::store
