#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "vsplit/base/execution_context.h"
#include "vsplit/base/expected.h"
#include "vsplit/io/mesh_format.h"
#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// The nodes in the middles of sides that make second-order triangles of a mesh's faces.
struct MidsideNodes {
    std::vector<Vec3> positions;    ///< numbered from the mesh's vertex count on, one an edge
    std::vector<Triangle> of_face;  ///< numbers: [i] is between the corners i and i + 1
    std::uint32_t on_chord = 0;  ///< edges whose node stays in the middle of the chord, as a curved side would make a bad element
};

/// Mid-side nodes on `source`: of each edge the point of the source that is nearest to its middle. A node stays in the middle of
/// the chord where that point is further off than a quarter of the edge (it is of another part of the surface), and where an
/// element would have a Jacobian anywhere under a fifth of its flat triangle's: so none is inverted.
///
/// \pre indices are below the number of vertices, coordinates finite. \return EMPTY_INPUT where the source has no faces,
/// CANCELLED. O(edges log(source faces)). The same bits for any number of threads.
[[nodiscard]] Expected<MidsideNodes> midside_nodes(const TriangleMesh& mesh, const TriangleMesh& source,
                                                   const ExecutionContext& context);

/// Whether a format has triangles of six nodes: MSH, INP (S6), BDF (CTRIA6), VTK and VTU.
[[nodiscard]] bool has_second_order(MeshFormat format);

/// As write_mesh, with elements of six nodes. \return UNSUPPORTED (field "order") for a format that has none.
[[nodiscard]] Expected<std::string> write_second_order(const TriangleMesh& mesh, const MidsideNodes& nodes, MeshFormat format);

/// As write_mesh_file. \return also UNSUPPORTED.
[[nodiscard]] Status write_second_order_file(const TriangleMesh& mesh, const MidsideNodes& nodes, MeshFormat format,
                                             const std::filesystem::path& path);

}  // namespace vsplit
