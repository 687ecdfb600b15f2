#pragma once

#include <cstdint>

#include "vsplit/base/execution_context.h"
#include "vsplit/base/expected.h"
#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// How close the bounds of a measured distance are to be. The measure refines until upper - lower is at most the larger of the
/// two tolerances.
struct DeviationOptions {
    double relative_error = 0.02;   ///< share of the lower bound; 0 to 1
    double absolute_error = 0;      ///< length, model units; >= 0. 0: 1e-5 of the source's bounding-box diagonal
    std::uint64_t evaluations = 0;  ///< most pieces to look at, each way, those where a nearest point is hard to find counting
                                    ///< several times; 0: a million and 200 for each face or crease of both
};

/// The largest distance from the points of one thing to another thing. It lies in [lower, upper], up to the rounding of the
/// coordinates: not by sampling but by bounds that hold between samples.
struct DirectedDeviation {
    double lower = 0;        ///< attained at `at`; length, model units
    double upper = 0;        ///< infinity where there is nothing to be near to
    Vec3 at = Vec3::Zero();  ///< on the thing that is measured from
};

/// Both ways.
struct Deviation {
    DirectedDeviation to_source;    ///< from the points of the result to the source
    DirectedDeviation from_source;  ///< from the points of the source to the result

    /// No point of either is further than this from the other.
    [[nodiscard]] double max() const { return to_source.upper > from_source.upper ? to_source.upper : from_source.upper; }
    /// A point of one of them is this far from the other.
    [[nodiscard]] double measured() const { return to_source.lower > from_source.lower ? to_source.lower : from_source.lower; }
};

/// The two-sided (Hausdorff) distance between two triangle meshes, open or closed, manifold or not, by branch and bound: faces
/// are cut into pieces until the bound of each is within the tolerance of the largest distance found. Where the budget of
/// evaluations ends first the bounds are wider than asked, and still true.
///
/// Progress has the one stage "measure". \pre indices of faces are below the number of vertices, coordinates finite.
/// \return INVALID_OPTION (relative_error, absolute_error), EMPTY_INPUT where a mesh has no faces, CANCELLED.
/// Time about that of 1 to 10 nearest-point queries a face of both; memory 250 bytes a face. The same bits for any number of
/// threads.
[[nodiscard]] Expected<Deviation> measure_deviation(const TriangleMesh& result, const TriangleMesh& source,
                                                    const DeviationOptions& options, const ExecutionContext& context);

}  // namespace vsplit
