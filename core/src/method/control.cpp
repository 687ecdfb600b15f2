#include "vsplit/method/control.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <utility>

#include "base/thread_limit.h"
#include "method/carry_regions.h"
#include "method/control_bounds.h"
#include "method/flip_slivers.h"
#include "method/mend_hubs.h"
#include "method/nearby_faces.h"
#include "method/run_policy.h"
#include "method/subdivision.h"
#include "vsplit/mesh/inspect.h"
#include "vsplit/mrr/progressive_mesh.h"
#include "vsplit/quality/stretch.h"

namespace vsplit {
namespace {

constexpr std::uint32_t kDefaultSubdivisions = 1;

ControlPolicy policy_of(const ControlOptions& used, double diagonal) {
    ControlPolicy policy;
    static_cast<FaceBounds&>(policy) = face_bounds(used);
    if (used.max_size) policy.max_size = *used.max_size;
    if (used.max_valence) policy.max_valence = *used.max_valence;
    policy.floor = used.mode == Mode::kExtended ? kExtendedFloor : 0;
    policy.size_unit = used.max_size.value_or(diagonal);
    return policy;
}

/// One-to-four, and midpoints in what is still over max_size: no collapse makes a face smaller.
Expected<SubdividedMesh> subdivide(const TriangleMesh& mesh, const std::optional<SizePlan>& sizes, const ControlOptions& used,
                                   bool frozen, const FaceLimit& limit, const ExecutionContext& context) {
    const auto quartered = [&](const TriangleMesh& m) {
        return frozen ? subdivide_one_to_four_inside(m, *used.subdivisions, limit, context)
                      : subdivide_one_to_four(m, *used.subdivisions, limit, context);
    };
    Expected<SubdividedMesh> fine = sizes ? to_sizes(mesh, *sizes, frozen, limit, context) : quartered(mesh);
    if (fine && sizes) fine = refined(*std::move(fine), quartered);
    if (!fine || !used.max_size) return fine;
    fine = refined(*std::move(fine), [&](const TriangleMesh& m) { return to_size(m, *used.max_size, frozen, limit, context); });
    if (fine) return fine;
    Error error = fine.error();
    if (error.field == "subdivision_size") error.field = "max_size";
    return error;
}

/// The mean edge of the faces asked for.
double usual_size(const TriangleMesh& mesh, const ControlOptions& used) {
    return std::sqrt(surface_area(mesh) / (kEquilateralArea * *used.faces));
}

}  // namespace

ControlOptions default_options(const TriangleMesh& mesh, const ControlOptions& options) {
    ControlOptions used = options;
    used.subdivisions = options.subdivisions.value_or(kDefaultSubdivisions);
    used.mode = options.mode.value_or(Mode::kExtended);
    fill_tolerances(extent_of(mesh), used);
    used.min_stretch = options.min_stretch.value_or(kStretchFloor);
    used.feature_detection = options.feature_detection.value_or(FeatureDetection::kDihedral);
    used.feature_angle = options.feature_angle.value_or(kDefaultFeatureAngle);
    used.feature_weight = options.feature_weight.value_or(kDefaultFeatureWeight);
    used.faces = options.faces ? *options.faces : std::max(mesh.face_count(), options.faces_min.value_or(kLeastFaces));
    used.faces_min = options.faces_min.value_or(kLeastFaces);
    used.freeze_boundary = options.freeze_boundary.value_or(false);
    return used;
}

namespace {

Expected<MethodResult> control_with(const TriangleMesh& mesh, const ControlOptions& given, const MethodLimits& limits,
                                    const ExecutionContext& context) {
    const auto start = std::chrono::steady_clock::now();
    const ControlOptions options = with_regions(mesh, given);
    if (Status valid = check_options(options); !valid) return valid.error();
    context.report({"inspect", 0, mesh.face_count()});
    const MeshReport report = inspect(mesh);
    if (Status manifold = require_manifold(report); !manifold) return manifold.error();
    if (Status fitting = check_options_on(mesh, options); !fitting) return fitting.error();
    const ControlOptions used = default_options(mesh, options);

    const bool extended = used.mode == Mode::kExtended;
    const bool has_field = used.sizing && !used.sizing->field.empty();
    const bool may_mend = extended || (report.closed && !has_field);
    const std::shared_ptr<const CreasedMesh> mended = may_mend ? mend_hubs(mesh, used, context) : nullptr;
    const std::shared_ptr<const CreasedMesh> flipped =
        extended && !mended ? without_slivers(mesh, used, usual_size(mesh, used), context) : mended;
    const TriangleMesh& coarse = flipped ? flipped->mesh : mesh;
    std::optional<SizePlan> sizes;
    if (used.sizing) {
        const SizingOptions sizing = flipped && has_field ? with_field_on(flipped->mesh, mesh, *used.sizing) : *used.sizing;
        Expected<SizePlan> plan = plan_sizes(coarse, sizing, creases_of(mesh, flipped, used), usual_size(mesh, used));
        if (!plan) return plan.error();
        sizes = *std::move(plan);
    }
    const bool frozen = *used.freeze_boundary && !report.closed;
    Expected<SubdividedMesh> subdivided = subdivide(coarse, sizes, used, frozen, {limits.max_faces, limits.admit}, context);
    if (!subdivided) return subdivided.error();
    MethodRun run;
    run.prepare = {.features = feature_options(used),
                   .tolerance = *used.tolerance,
                   .faces_min = *used.faces_min,
                   .faces = *used.faces,
                   .freeze_boundary = frozen,
                   .closed = report.closed,
                   .sizes = sizes ? &*sizes : nullptr,
                   .replaced = flipped};
    run.extended = extended;
    run.max_deviation = used.max_deviation.value_or(0);
    run.limit = options.max_deviation;
    const auto faces_of = [&](const MultiresMesh& mrr) { return faces_that_keep_bounds(mrr, used, options.faces.has_value()); };
    Expected<MethodResult> tried =
        run_policy(mesh, std::move(*subdivided), run, policy_of(used, bounding_box(mesh).diagonal()), faces_of, context);
    if (!tried) return tried.error();
    MethodResult result = *std::move(tried);
    carry_regions(mesh, options.regions, result.mrr);
    ControlOptions kept = used;
    kept.max_deviation = deviation_kept(result, used, options.max_deviation.has_value());
    result.options = kept;
    const TriangleMesh shown = mesh_at(result.mrr, result.mrr.level_for(result.faces));
    result.violations = find_violations(shown, used);
    explain(result, shown, used);
    if (sizes) report_sizes(result, coarse, *sizes);
    report_deviation(result, options.max_deviation);
    result.elapsed = std::chrono::steady_clock::now() - start;
    return result;
}

}  // namespace

Expected<MethodResult> control(const TriangleMesh& mesh, const ControlOptions& options, const MethodLimits& limits,
                               const ExecutionContext& context) {
    return with_thread_limit(context, [&] { return control_with(mesh, options, limits, context); });
}

}  // namespace vsplit
