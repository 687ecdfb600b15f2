#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "simplify/policies.h"
#include "spatial/surface_index.h"
#include "vsplit/base/execution_context.h"
#include "vsplit/base/expected.h"
#include "vsplit/features/sharp_edges.h"
#include "vsplit/mrr/multires_mesh.h"
#include "vsplit/simplify/quadric.h"

namespace vsplit {

/// What a simplification starts from.
struct SimplifyInput {
    TriangleMesh mesh;                     ///< closed 2-manifold; open boundaries closed by ghosts (see CappedMesh)
    std::vector<Eigen::Vector3f> normals;  ///< one a face, unit (see FaceNormals); anything for ghost faces
    std::vector<Quadric> quadrics;         ///< one a vertex, of points relative to `centre`
    Vec3 centre = Vec3::Zero();
    std::vector<SharpEdge> creases;               ///< of `mesh`; the extended mode keeps them apart
    double crease_cosine = -1;                    ///< of the angle from which on an edge is one
    std::shared_ptr<const SurfaceIndex> source;   ///< what max_deviation is measured from; null for no bound
    std::uint32_t ghosts = 0;                     ///< how many of the first vertices are ghosts
    std::vector<std::uint32_t> boundary_corners;  ///< vertices on boundaries that stay where they are
    bool freeze_boundary = false;                 ///< all vertices and edges of boundaries stay as they are
    double max_deviation = 0;                     ///< length; samples of both surfaces stay within it of the other
    std::vector<double> sizes;                    ///< allowed, one a vertex, or none given; see VertexSizes
    double usual_size = 0;                        ///< wanted where more is allowed
    bool sizes_bind = false;                      ///< no longer edges than `sizes` allow
    double tolerance = 0;                         ///< length; tau_TL is its square
    double mean_floor = 0;                        ///< of stretch: ends where the mean gets less ...
    std::uint32_t floor_from = 0;                 ///< ... with no more than so many faces
    std::uint32_t faces_min = 4;                  ///< stop here at the latest; numbers of faces are of visible ones
    std::uint32_t faces = 4;                      ///< the resolution that is asked for: the extended mode polishes it longest
};

/// The simplifier of both methods ([Date05] 4.2, Fig. 7): collapses the valid edge of largest priority until none is left or
/// faces_min is reached. On an open boundary vertices join only along it, corners of it stay, and a vertex from inside joins it
/// where it is; no loop gets under three edges. Collapses are exactly in order of priority, ties by edge number.
///
/// An `Extended` policy cuts a large mesh into parts that are worked on at the same time (MeshParts), each in that order, and
/// then between them: the result is the same whatever the number of threads. It adds flips after each collapse, and rounds of
/// flips and moves of vertices to begin with, whenever a fifth of the faces is gone, and at `faces`; they are records of the MRR
/// as collapses are.
///
/// Takes as many threads as the task arena it is called in. Stages "evaluate" and "simplify". CANCELLED. O(n log n) for bounded
/// valence.
[[nodiscard]] Expected<MultiresMesh> simplify(SimplifyInput input, const ImprovePolicy& policy, const ExecutionContext& context);
[[nodiscard]] Expected<MultiresMesh> simplify(SimplifyInput input, const ControlPolicy& policy, const ExecutionContext& context);
[[nodiscard]] Expected<MultiresMesh> simplify(SimplifyInput input, const Extended<ImprovePolicy>& policy,
                                              const ExecutionContext& context);
[[nodiscard]] Expected<MultiresMesh> simplify(SimplifyInput input, const Extended<ControlPolicy>& policy,
                                              const ExecutionContext& context);

}  // namespace vsplit
