#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "vsplit/base/expected.h"
#include "vsplit/mesh/face_groups.h"
#include "vsplit/mesh/finding.h"
#include "vsplit/mesh/length_unit.h"
#include "vsplit/mesh/triangle_mesh.h"
#include "vsplit/mesh/weld.h"
#include "vsplit/quality/mesh_quality.h"

namespace vsplit {

/// Counts and topology of a mesh.
struct MeshReport {
    std::uint32_t vertices = 0;
    std::uint32_t faces = 0;
    bool closed = false;           ///< no boundary edge, no duplicate face, manifold
    std::uint32_t components = 0;  ///< connected by shared edges
    std::int32_t genus = 0;        ///< summed over components; meaningful when closed, else 0
    std::uint32_t boundary_edges = 0;
    std::uint32_t non_manifold_edges = 0;
    std::uint32_t inconsistent_edges = 0;
    std::uint32_t non_manifold_vertices = 0;
    std::vector<std::uint32_t> boundary_touches;  ///< the first kExamples of those at which the boundary touches itself
    std::uint32_t degenerate_faces = 0;           ///< stretch under 1e-9
    std::uint32_t duplicate_faces = 0;
    std::optional<LengthUnit> unit{};  ///< of all lengths here; a mesh does not know it: whoever read it fills it in
    BoundingBox box;
    Quality quality;
    std::vector<Finding> findings;
    FaceGroups groups{};
};

/// Looks at everything above; `weld` is what was dropped when the mesh was read, for the findings. O(faces log faces) time, 40
/// bytes a face of memory. \pre every index is below the number of vertices (what `read_mesh` and `weld` return).
[[nodiscard]] MeshReport inspect(const TriangleMesh& mesh, const WeldCounts& weld = {});

/// Whether a mesh is closed, manifold and consistently oriented, no two faces on the same three vertices.
/// \return NON_MANIFOLD or OPEN_MESH naming the first edges at fault, EMPTY_INPUT for no faces.
[[nodiscard]] Status require_closed_manifold(const MeshReport& report);

/// Whether a closed mesh's faces look outwards. \return NON_MANIFOLD where they look inwards.
[[nodiscard]] Status require_outward(const MeshReport& report);

/// Whether the methods accept this mesh: as above, but it may have open boundaries that do not touch themselves.
/// \return NON_MANIFOLD naming the first edges or vertices at fault, EMPTY_INPUT for no faces.
[[nodiscard]] Status require_manifold(const MeshReport& report);

}  // namespace vsplit
