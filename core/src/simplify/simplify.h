#pragma once

#include <cstdint>
#include <vector>

#include "simplify/policies.h"
#include "vsplit/base/execution_context.h"
#include "vsplit/base/expected.h"
#include "vsplit/mrr/multires_mesh.h"
#include "vsplit/simplify/quadric.h"

namespace vsplit {

/// What a simplification starts from.
struct SimplifyInput {
    TriangleMesh mesh;              ///< closed 2-manifold
    std::vector<Vec3> normals;      ///< one a face, unit (see FaceNormals)
    std::vector<Quadric> quadrics;  ///< one a vertex, of points relative to `centre`
    Vec3 centre = Vec3::Zero();
    double tolerance = 0;         ///< length; tau_TL is its square
    std::uint32_t faces_min = 4;  ///< stop here at the latest
};

/// The simplifier of both methods ([Date05] 4.2, Fig. 7): collapses the valid edge of largest priority until none is left or
/// faces_min is reached. Collapses are exactly in order of priority, ties by edge number, whatever the number of threads.
///
/// Takes as many threads as the task arena it is called in. Stages "evaluate" and "simplify". CANCELLED. O(n log n) for bounded
/// valence.
[[nodiscard]] Expected<MultiresMesh> simplify(SimplifyInput input, const ImprovePolicy& policy, const ExecutionContext& context);
[[nodiscard]] Expected<MultiresMesh> simplify(SimplifyInput input, const ControlPolicy& policy, const ExecutionContext& context);

}  // namespace vsplit
