#include "vsplit/method/improve.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

#include "base/thread_limit.h"
#include "method/carry_regions.h"
#include "method/flip_slivers.h"
#include "method/run_policy.h"
#include "method/subdivision.h"
#include "vsplit/mesh/inspect.h"
#include "vsplit/quality/stretch.h"

namespace vsplit {
namespace {

/// What is taken where nothing is given: the subdivision size as a share of the mesh's extent, and the mean edge of the result
/// over it. The paper's method needs edges well under those of the result; with flips and moves the same size does.
struct DefaultSizes {
    double size_share = 0.01;
    double mean_edge_over_size = 1.5;
};
constexpr DefaultSizes kStrictSizes{0.01, 1.5};
constexpr DefaultSizes kExtendedSizes{0.015, 1};

/// Mean stretch under which the extended mode does not go on by itself: a resolution coarser by a fifth is worse then by more
/// than polishing gains.
constexpr double kMeanFloor = 0.8;

/// Where creases lie so close that all faces of the default size have corners on them, the floor is never reached. Smaller by
/// this much it may be; for less than kMissedShare of the floor it is worth another run.
constexpr double kFinerSize = 0.4;
constexpr double kMissedShare = 0.97;

constexpr double kSizeGrowth = 1.25;
/// Faces after subdivision that an interactive user waits for. Needles that are cut stay needles until they are millions.
constexpr std::uint32_t kFaceBudget = 1'000'000;
constexpr std::uint32_t kNeedleBudget = 50'000;
/// Strict mode: where nothing more can be collapsed within the tolerance shape has suffered; with twice the faces it is near its
/// best.
constexpr std::uint32_t kFacesOverCoarsest = 2;

std::uint32_t face_budget(const TriangleMesh& mesh, std::uint32_t host_limit) {
    return std::min(host_limit, slenderness(mesh) > kNeedles ? std::max(kNeedleBudget, mesh.face_count()) : kFaceBudget);
}

double edge_of_faces(const TriangleMesh& mesh, std::uint32_t faces) {
    return std::sqrt(surface_area(mesh) / (kEquilateralArea * faces));
}

/// The size of edges that is wanted where none is given, whatever it costs. Extended mode.
double wanted_size(const TriangleMesh& mesh, const ImproveOptions& options) {
    if (options.subdivision_size) return *options.subdivision_size;
    return options.faces ? edge_of_faces(mesh, *options.faces) : kExtendedSizes.size_share * extent_of(mesh);
}

/// `size`, or the next larger one that keeps to what an interactive user waits for.
double affordable_size(const TriangleMesh& mesh, double size, double diagonal, std::uint32_t host_limit,
                       const ExecutionContext& context) {
    const std::uint32_t face_limit = face_budget(mesh, host_limit);
    while (size < diagonal && predict_subdivision(mesh, size, face_limit, &context) > face_limit) size *= kSizeGrowth;
    return size;
}

/// `fineness`: of what it would be else.
double default_subdivision_size(const TriangleMesh& mesh, const ImproveOptions& options, double diagonal,
                                std::uint32_t host_limit, double fineness, const ExecutionContext& context) {
    if (options.mode == Mode::kStrict)
        return affordable_size(mesh, kStrictSizes.size_share * diagonal, diagonal, host_limit, context);
    const double size = wanted_size(mesh, options);
    return size > 0 ? affordable_size(mesh, fineness * size, diagonal, host_limit, context) : diagonal;
}

std::uint32_t face_count(double faces) { return static_cast<std::uint32_t>(std::clamp(faces, 4.0, 4e9)); }

std::uint32_t default_faces(const TriangleMesh& mesh, const ImproveOptions& used) {
    const DefaultSizes& sizes = used.mode == Mode::kStrict ? kStrictSizes : kExtendedSizes;
    const double edge = sizes.mean_edge_over_size * *used.subdivision_size;
    const double faces = surface_area(mesh) / (kEquilateralArea * edge * edge);
    return face_count(faces);
}

ImprovePolicy policy_of(const ImproveOptions& used) {
    ImprovePolicy policy;
    policy.floor = *used.min_stretch;
    if (used.mode == Mode::kExtended) policy.min_stretch = kStretchFloor;  // what is left under it is mended if that can be
    return policy;
}

/// Sizes follow what is asked for, or curvature where neither sizes nor a number of faces are.
Expected<std::optional<SizePlan>> plan_for(const TriangleMesh& mesh, const std::vector<SharpEdge>& creases,
                                           const ImproveOptions& asked, const ImproveOptions& used, const MethodLimits& limits,
                                           const ExecutionContext& context) {
    const auto given = [](Expected<SizePlan> plan) -> Expected<std::optional<SizePlan>> {
        if (!plan) return plan.error();
        return std::optional<SizePlan>(*std::move(plan));
    };
    if (used.sizing) return given(plan_sizes(mesh, *used.sizing, creases, *used.subdivision_size));
    if (used.mode == Mode::kStrict || asked.faces || asked.subdivision_size) return std::optional<SizePlan>();
    // A tolerance far below the default is about the facets of the source; their angles are no curvature.
    const double tolerance = std::max(*used.tolerance, kDefaultToleranceShare * extent_of(mesh));
    return given(
        plan_by_curvature(mesh, creases, tolerance, *used.subdivision_size, face_budget(mesh, limits.max_faces), context));
}

/// To the sizes that are planned where they are smaller, and to `size`.
Expected<SubdividedMesh> subdivide(const TriangleMesh& mesh, const std::optional<SizePlan>& sizes, double size, bool frozen,
                                   const FaceLimit& limit, const ExecutionContext& context) {
    const auto to_usual = [&](const TriangleMesh& m) { return to_size(m, size, frozen, limit, context); };
    if (!sizes) return to_usual(mesh);
    Expected<SubdividedMesh> sized = to_sizes(mesh, *sizes, frozen, limit, context);
    return sized ? refined(*std::move(sized), to_usual) : sized;
}

/// A violation where the shown resolution has less mean stretch than was asked for.
void report_floor(MethodResult& result, std::optional<double> floor) {
    if (!floor || result.quality.stretch_mean >= *floor) return;
    Violation violation;
    violation.bound = "min_mean_stretch";
    violation.limit = *floor;
    violation.worst = result.quality.stretch_mean;
    violation.count = result.faces;
    violation.reason =
        "no resolution with no more faces than asked for has it; more faces, a smaller subdivision size or a larger tolerance "
        "may";
    result.violations.push_back(std::move(violation));
}

ImproveOptions options_as_used(const TriangleMesh& mesh, const ImproveOptions& options, const MethodLimits& limits,
                               double fineness, const ExecutionContext& context) {
    const double diagonal = bounding_box(mesh).diagonal();
    ImproveOptions used = options;
    used.mode = options.mode.value_or(Mode::kExtended);
    if (!used.subdivision_size)
        used.subdivision_size = default_subdivision_size(mesh, used, diagonal, limits.max_faces, fineness, context);
    fill_tolerances(extent_of(mesh), used);
    used.feature_detection = options.feature_detection.value_or(FeatureDetection::kDihedral);
    used.feature_angle = options.feature_angle.value_or(kDefaultFeatureAngle);
    used.feature_weight = options.feature_weight.value_or(kDefaultFeatureWeight);
    const bool extended = used.mode == Mode::kExtended;
    used.min_stretch = options.min_stretch.value_or(extended ? kExtendedFloor : 0);
    used.min_mean_stretch = options.min_mean_stretch.value_or(extended && !options.faces_min ? kMeanFloor : 0);
    used.faces = options.faces ? *options.faces : std::max(default_faces(mesh, used), options.faces_min.value_or(4));
    used.faces_min = options.faces_min.value_or(kLeastFaces);
    used.freeze_boundary = options.freeze_boundary.value_or(false);
    return used;
}

/// What is the same for every fineness: the source, what is asked of it, and what is subdivided in its place.
struct Ground {
    const TriangleMesh& mesh;
    ImproveOptions options;
    bool closed = false;
    std::shared_ptr<const CreasedMesh> flipped{};  ///< null: the source itself
    double fineness = 1;                           ///< to begin with, where neither faces nor a size are given

    [[nodiscard]] const TriangleMesh& coarse() const { return flipped ? flipped->mesh : mesh; }
};

/// \return what is wrong with the options or the mesh.
Expected<Ground> ground_for(const TriangleMesh& mesh, const ImproveOptions& asked, const MethodLimits& limits,
                            const ExecutionContext& context) {
    Ground ground{mesh, with_regions(mesh, asked)};
    const ImproveOptions& options = ground.options;
    if (Status valid = check_options(options); !valid) return valid.error();
    context.report({"inspect", 0, mesh.face_count()});
    const MeshReport report = inspect(mesh);
    if (Status manifold = require_manifold(report); !manifold) return manifold.error();
    if (Status fitting = check_options_on(mesh, options); !fitting) return fitting.error();
    ground.closed = report.closed;
    if (options.mode == Mode::kStrict) return ground;
    const bool given_size = options.faces || options.subdivision_size;
    if (!given_size && slenderness(mesh) > kNeedles) ground.fineness = kFinerSize;  // what is so thin needs it
    ground.flipped = without_slivers(mesh, options_as_used(mesh, options, limits, 1, context),
                                     ground.fineness * wanted_size(mesh, options), context);
    return ground;
}

Expected<MethodResult> improve_once(const Ground& ground, const MethodLimits& limits, double fineness,
                                    const ExecutionContext& context) {
    const TriangleMesh& mesh = ground.mesh;
    const ImproveOptions& options = ground.options;
    const TriangleMesh& coarse = ground.coarse();
    ImproveOptions used = options_as_used(coarse, options, limits, fineness, context);
    const bool extended = used.mode == Mode::kExtended;
    const Expected<std::optional<SizePlan>> sizes =
        plan_for(coarse, creases_of(mesh, ground.flipped, used), options, used, limits, context);
    if (!sizes) return sizes.error();
    const bool frozen = *used.freeze_boundary && !ground.closed;
    Expected<SubdividedMesh> subdivided =
        subdivide(coarse, *sizes, *used.subdivision_size, frozen, {limits.max_faces, limits.admit}, context);
    if (!subdivided) return subdivided.error();
    if (*sizes && !options.faces) used.faces = std::max(face_count(wanted_faces(*subdivided, coarse, **sizes)), *used.faces_min);
    MethodRun run;
    run.prepare = {.features = feature_options(used),
                   .tolerance = *used.tolerance,
                   .faces_min = *used.faces_min,
                   .faces = *used.faces,
                   .mean_floor = *used.min_mean_stretch,
                   .floor_from = options.faces.value_or(std::numeric_limits<std::uint32_t>::max()),
                   .freeze_boundary = frozen,
                   .closed = ground.closed,
                   .sizes = *sizes ? &**sizes : nullptr,
                   .replaced = ground.flipped};
    run.extended = extended;
    run.max_deviation = used.max_deviation.value_or(0);
    run.limit = options.max_deviation;
    const auto faces_of = [&](const MultiresMesh& mrr) {
        return options.faces || extended ? *used.faces : std::max(*used.faces, kFacesOverCoarsest * mrr.faces_min());
    };
    Expected<MethodResult> tried = run_policy(mesh, std::move(*subdivided), run, policy_of(used), faces_of, context);
    if (!tried) return tried.error();
    MethodResult result = *std::move(tried);
    carry_regions(mesh, options.regions, result.mrr);
    if (options.sizing) report_sizes(result, coarse, **sizes);
    report_deviation(result, options.max_deviation);
    report_floor(result, options.min_mean_stretch);
    if (!options.faces) used.faces = result.faces;
    used.max_deviation = deviation_kept(result, used, options.max_deviation.has_value());
    result.options = used;
    return result;
}

/// Whether faces of a smaller default size may have the mean stretch that these have not.
bool may_be_finer(const Ground& ground, const MethodResult& result, const MethodLimits& limits, const ExecutionContext& context) {
    const auto& used = std::get<ImproveOptions>(result.options);
    if (used.mode == Mode::kStrict || ground.options.faces || ground.options.subdivision_size) return false;
    if (result.quality.stretch_mean >= kMissedShare * *used.min_mean_stretch) return false;
    const ImproveOptions finer = options_as_used(ground.coarse(), ground.options, limits, kFinerSize, context);
    return *finer.subdivision_size < *used.subdivision_size;
}

Expected<MethodResult> improve_with(const TriangleMesh& mesh, const ImproveOptions& options, const MethodLimits& limits,
                                    const ExecutionContext& context) {
    const auto start = std::chrono::steady_clock::now();
    const Expected<Ground> ground = ground_for(mesh, options, limits, context);
    if (!ground) return ground.error();
    Expected<MethodResult> result = improve_once(*ground, limits, ground->fineness, context);
    if (result && may_be_finer(*ground, *result, limits, context)) result = improve_once(*ground, limits, kFinerSize, context);
    if (result) result->elapsed = std::chrono::steady_clock::now() - start;
    return result;
}

}  // namespace

ImproveOptions default_options(const TriangleMesh& mesh, const ImproveOptions& options, const MethodLimits& limits) {
    return options_as_used(mesh, options, limits, 1, ExecutionContext());
}

Expected<MethodResult> improve(const TriangleMesh& mesh, const ImproveOptions& options, const MethodLimits& limits,
                               const ExecutionContext& context) {
    return with_thread_limit(context, [&] { return improve_with(mesh, options, limits, context); });
}

}  // namespace vsplit
