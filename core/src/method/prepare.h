#pragma once

#include "simplify/simplify.h"
#include "spatial/surface_index.h"
#include "vsplit/features/creases.h"
#include "vsplit/method/method_result.h"
#include "vsplit/subdivide/subdivide.h"

namespace vsplit {

/// A mesh and its creases.
struct CreasedMesh {
    TriangleMesh mesh;
    std::vector<SharpEdge> creases;
};

/// What both methods hand to the simplifier, defaults filled in.
struct PrepareOptions {
    FeatureOptions features;
    double tolerance = 0;
    std::uint32_t faces_min = 0;
    std::uint32_t faces = 0;
    std::shared_ptr<const CreasedMesh> mended{};  ///< what was subdivided in place of the source; null: the source itself
};

/// Normals, creases and quadrics of a subdivided mesh. Normals are those of the source's faces: subdivision does not change the
/// surface, but slivers cut small no longer show where they look. O(faces).
[[nodiscard]] SimplifyInput prepare(const TriangleMesh& source, SubdividedMesh subdivided, const PrepareOptions& options);

/// Fills in `tolerance` and, in the extended mode, `max_deviation`: either follows from the other where that is given.
template <class Options>
void fill_tolerances(double diagonal, Options& options) {
    constexpr double kDeviationOverTolerance = 2;
    if (!options.tolerance) {
        options.tolerance =
            options.max_deviation ? *options.max_deviation / kDeviationOverTolerance : kDefaultToleranceShare * diagonal;
    }
    if (options.mode == Mode::kExtended && !options.max_deviation) {
        options.max_deviation = kDeviationOverTolerance * *options.tolerance;
    }
}

/// Has the simplifier keep its samples within `distance` of `source`, both ways. O(faces log faces).
void guard(SimplifyInput& input, const TriangleMesh& source, double distance);

/// Measures how far the result's shown resolution and its source are apart. Where that is more than `limit` and it `may_refine`,
/// shows a finer resolution that keeps to it, or else the finest. Does nothing without an index of the source. Stage "measure".
/// \return CANCELLED.
[[nodiscard]] Status measure(MethodResult& result, const TriangleMesh& source, const SurfaceIndex* source_index,
                             std::optional<double> limit, bool may_refine, const ExecutionContext& context);

/// A violation where the shown resolution was measured to be further than `limit` from the source.
void report_deviation(MethodResult& result, std::optional<double> limit);

/// The resolution of `mrr` nearest to `faces`, and its figures.
[[nodiscard]] MethodResult describe_resolution(MultiresMesh mrr, std::uint32_t faces);

}  // namespace vsplit
