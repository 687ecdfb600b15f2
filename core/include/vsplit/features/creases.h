#pragma once

#include <cstdint>
#include <vector>

#include "vsplit/base/expected.h"
#include "vsplit/features/face_normals.h"
#include "vsplit/features/feature_detection.h"
#include "vsplit/features/sharp_edges.h"
#include "vsplit/mesh/triangle_mesh.h"
#include "vsplit/subdivide/subdivide.h"

namespace vsplit {

/// Everything that makes an edge a crease.
struct FeatureOptions {
    FeatureDetection detection = FeatureDetection::kDihedral;
    double angle = 40;        ///< degrees, 0..180: as in SharpEdgeOptions, for either detection
    double weight = 10;       ///< as in SharpEdgeOptions; what is marked, a border or a boundary weighs at least this
    double least_branch = 0;  ///< length, model units, >= 0: shorter sharp edges that end freely go where many do, as on a scan;
                              ///< DIHEDRAL only. 0: none goes
    std::vector<std::uint32_t> marked_edges{};  ///< edges the user marks, as pairs of vertices of the mesh; default none
    std::vector<std::uint32_t> regions{};       ///< an id a face; edges between faces of different ids are creases. Default none
};

/// Whether `marked_edges` and `regions` fit `mesh`.
/// \return INVALID_OPTION naming the field, the first element at fault and what would be accepted. O(faces).
[[nodiscard]] Status check_features(const TriangleMesh& mesh, const std::vector<std::uint32_t>& marked_edges,
                                    const std::vector<std::uint32_t>& regions);

/// Creases of `mesh`, each edge once, in order of their first half-edge: edges that the detection finds sharp, marked edges,
/// borders of regions, and edges with one face. NORMAL_VOTING weighs an edge by the angle between the voted normals, and leaves
/// out chains shorter than a neighbourhood, which noise makes. O(faces) for DIHEDRAL, see `vote_normals` for NORMAL_VOTING. \pre
/// `mesh` is manifold; `normals` belong to it; `check_features` found nothing.
[[nodiscard]] std::vector<SharpEdge> find_creases(const TriangleMesh& mesh, const FaceNormals& normals,
                                                  const FeatureOptions& options);

/// The pieces of the source's `creases` in a subdivision of it, in order of their first half-edge, with the weights they had.
/// O(faces). \pre `fine.parent` names faces of `source`, and `fine` covers the same surface.
[[nodiscard]] std::vector<SharpEdge> creases_on(const SubdividedMesh& fine, const TriangleMesh& source,
                                                const std::vector<SharpEdge>& creases);

}  // namespace vsplit
