#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "vsplit/base/expected.h"
#include "vsplit/mesh/triangle_mesh.h"
#include "vsplit/mesh/weld.h"
#include "vsplit/quality/mesh_quality.h"

namespace vsplit {

/// Something about a mesh that a person may want to know, with the places to look at.
struct Finding {
    enum class Kind {
        kBoundaryEdge,       ///< one face only
        kNonManifoldEdge,    ///< more than two faces
        kInconsistentEdge,   ///< two faces that run along it in the same direction
        kNonManifoldVertex,  ///< more than one fan of faces
        kDegenerateFace,     ///< stretch under 1e-9
        kDuplicateFace,      ///< the same three vertices as an earlier face
        kUnusedVertex,       ///< no face used it; dropped by the weld
        kCollapsedFace,      ///< two corners equal after the weld; dropped
    };
    static constexpr std::size_t kExamples = 16;

    Kind kind{};
    std::uint32_t count = 0;
    std::string message;                  ///< one sentence: what, how many, where the first is
    std::vector<std::uint32_t> elements;  ///< the first kExamples: face indices, vertex indices, or edges as vertex pairs
};

/// UPPER_SNAKE_CASE, e.g. "NON_MANIFOLD_EDGE".
[[nodiscard]] std::string_view finding_name(Finding::Kind kind);

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
    BoundingBox box;
    Quality quality;
    std::vector<Finding> findings;
};

/// Looks at everything above; `weld` is what was dropped when the mesh was read, for the findings. O(faces log faces) time, 40
/// bytes a face of memory. \pre every index is below the number of vertices (what `read_mesh` and `weld` return).
[[nodiscard]] MeshReport inspect(const TriangleMesh& mesh, const WeldCounts& weld = {});

/// Whether a mesh is closed, manifold and consistently oriented, no two faces on the same three vertices.
/// \return NON_MANIFOLD or OPEN_MESH naming the first edges at fault, EMPTY_INPUT for no faces.
[[nodiscard]] Status require_closed_manifold(const MeshReport& report);

/// Whether the methods accept this mesh: as above, but it may have open boundaries that do not touch themselves.
/// \return NON_MANIFOLD naming the first edges or vertices at fault, EMPTY_INPUT for no faces.
[[nodiscard]] Status require_manifold(const MeshReport& report);

}  // namespace vsplit
