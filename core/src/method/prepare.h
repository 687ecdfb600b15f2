#pragma once

#include <algorithm>
#include <limits>
#include <memory>

#include "method/size_plan.h"
#include "simplify/simplify.h"
#include "spatial/surface_index.h"
#include "vsplit/features/creases.h"
#include "vsplit/method/method_result.h"
#include "vsplit/quality/deviation.h"
#include "vsplit/subdivide/subdivide.h"

namespace vsplit {

/// A mesh and its creases.
struct CreasedMesh {
    TriangleMesh mesh;
    std::vector<SharpEdge> creases;
    double moved =
        std::numeric_limits<double>::infinity();  ///< the source is certainly no further from it, nor it from the source
};

/// What both methods hand to the simplifier, defaults filled in.
struct PrepareOptions {
    FeatureOptions features;
    double tolerance = 0;
    std::uint32_t faces_min = 0;
    std::uint32_t faces = 0;
    double mean_floor = 0;         ///< see SimplifyInput
    std::uint32_t floor_from = 0;  ///< see SimplifyInput
    bool freeze_boundary = false;
    bool closed = false;                            ///< the source is known to have no boundary, so none is looked for
    const SizePlan* sizes = nullptr;                ///< null: the same size everywhere
    std::shared_ptr<const CreasedMesh> replaced{};  ///< what was subdivided in place of the source; null: the source itself
};

/// Normals, creases and quadrics of a subdivided mesh, whose boundaries are then closed by ghosts. Normals are those of the
/// source's faces: subdivision does not change the surface, but slivers cut small no longer show where they look. O(faces).
[[nodiscard]] SimplifyInput prepare(const TriangleMesh& source, SubdividedMesh subdivided, const PrepareOptions& options);

/// Squares of the longest edges over the area of all faces: 2.3 where all are equilateral, far more where there are needles.
/// Infinity for a mesh without area. O(faces).
[[nodiscard]] double slenderness(const TriangleMesh& mesh);
/// From here on most of a mesh's faces are needles: cut at midpoints they stay needles until they are millions.
inline constexpr double kNeedles = 1e4;

/// What default lengths are shares of: the diagonal of the bounding box, or twice the root of the area where that is less. So of
/// a body that fills little of its box, as cables do, as many faces come out as of any other. O(faces).
[[nodiscard]] double extent_of(const TriangleMesh& mesh);

/// Fills in `tolerance` and, in the extended mode, `max_deviation`: either follows from the other where that is given, else from
/// the mesh's `extent`.
template <class Options>
void fill_tolerances(double extent, Options& options) {
    constexpr double kDeviationOverTolerance = 2;
    if (!options.tolerance) {
        options.tolerance =
            options.max_deviation ? *options.max_deviation / kDeviationOverTolerance : kDefaultToleranceShare * extent;
    }
    if (options.mode == Mode::kExtended && !options.max_deviation) {
        options.max_deviation = kDeviationOverTolerance * *options.tolerance;
    }
}

/// What deviations are measured from: the source, or what replaces it where that is nearly the same and the source is full of
/// needles.
struct Reference {
    const TriangleMesh& mesh;
    double moved = 0;  ///< the source is no further from it, nor it from the source
};
[[nodiscard]] Reference reference_for(const TriangleMesh& source, const std::shared_ptr<const CreasedMesh>& replaced);

/// Has the simplifier keep its samples within `distance` of `reference`, both ways. \return CANCELLED.
/// O(faces log faces).
[[nodiscard]] Status guard(SimplifyInput& input, const Reference& reference, double distance, const ExecutionContext& context);

/// How close distances to a source of this diagonal are measured: where a limit is given it is the upper bound that counts, and
/// a limit may be far below the default error.
[[nodiscard]] DeviationOptions accuracy_for(std::optional<double> limit, double diagonal);

/// Measures how far the result's shown resolution and its source are apart. Where that is more than `limit` and it `may_refine`,
/// shows a finer resolution that keeps to it, or else the finest. Does nothing without an index. Stage "measure".
/// \return CANCELLED.
[[nodiscard]] Status measure(MethodResult& result, const Reference& reference, const SurfaceIndex* reference_index,
                             std::optional<double> limit, bool may_refine, const ExecutionContext& context);

/// How far surface and creases were measured to be away, 0 where they were not.
[[nodiscard]] inline double furthest(const MethodResult& result) {
    return std::max(result.quality.deviation_max.value_or(0), result.quality.crease_deviation_max.value_or(0));
}

/// The max_deviation that holds: as used, or what was measured where that is more and none was given.
template <class Options>
[[nodiscard]] std::optional<double> deviation_kept(const MethodResult& result, const Options& used, bool given) {
    if (given || !used.max_deviation) return used.max_deviation;
    return std::max(*used.max_deviation, furthest(result));
}

/// A violation where the shown resolution was measured to be further than `limit` from the source.
void report_deviation(MethodResult& result, std::optional<double> limit);

/// A violation where edges of the shown resolution are longer than `plan` allows.
void report_sizes(MethodResult& result, const TriangleMesh& source, const SizePlan& plan);

/// The resolution of `mrr` nearest to `faces`, and its figures.
[[nodiscard]] MethodResult describe_resolution(MultiresMesh mrr, std::uint32_t faces);

}  // namespace vsplit
