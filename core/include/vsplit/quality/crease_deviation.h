#pragma once

#include <cstdint>

#include "vsplit/base/execution_context.h"
#include "vsplit/base/expected.h"
#include "vsplit/mesh/triangle_mesh.h"
#include "vsplit/quality/deviation.h"

namespace vsplit {

struct CreaseDeviationOptions {
    double angle = 40;         ///< degrees, 0 to 180: an edge whose faces' normals differ by more is a crease
    double lost_distance = 0;  ///< length, model units; >= 0. A source crease further than this from all of the result's is lost.
                               ///< 0: 0.2 % of the source's bounding-box diagonal
    double spacing = 0;        ///< most length of crease a sample stands for, model units; >= 0. 0: half of lost_distance
    DeviationOptions accuracy = {};  ///< of the distances
};

/// How well the source's creases are kept. Creases are edges with a dihedral angle over the threshold, and boundary edges.
struct CreaseDeviation {
    std::uint32_t source_creases = 0;  ///< edges
    std::uint32_t result_creases = 0;  ///< edges
    DirectedDeviation from_source;     ///< from the points of the source's creases to the result's; infinite where that has none
    double lost = 0;                   ///< share of the source's length of creases that is lost, by samples; 0 to 1
};

/// Distance between the creases of two meshes, certain as measure_deviation's; zero where the source has no crease.
///
/// Progress has the one stage "measure". \pre both are manifold, closed or open; coordinates are finite.
/// \return INVALID_OPTION (angle, lost_distance, spacing, relative_error, absolute_error), LIMIT_EXCEEDED (spacing) for more than
/// 10^8 samples, EMPTY_INPUT where a mesh has no faces, CANCELLED. O(faces + samples log creases) time.
[[nodiscard]] Expected<CreaseDeviation> measure_crease_deviation(const TriangleMesh& result, const TriangleMesh& source,
                                                                 const CreaseDeviationOptions& options,
                                                                 const ExecutionContext& context);

}  // namespace vsplit
