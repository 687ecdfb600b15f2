#include "vsplit/method/improve.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "base/thread_limit.h"
#include "method/prepare.h"
#include "vsplit/mesh/inspect.h"

namespace vsplit {
namespace {

constexpr double kDefaultSizeShare = 0.01;  // of the diagonal
constexpr double kSizeGrowth = 1.25;
constexpr std::uint64_t kDefaultFaceBudget = 1'000'000;
constexpr double kMeanEdgeOverSize = 1.5;  // the mean edge of the default resolution
/// Where nothing more can be collapsed within the tolerance shape has suffered; with twice the faces it is near its best.
constexpr std::uint32_t kFacesOverCoarsest = 2;
constexpr double kEquilateralArea = 0.4330127018922193;  // of edge 1

/// 1 % of the diagonal, or the next larger size that keeps to what an interactive user waits for.
double default_subdivision_size(const TriangleMesh& mesh, double diagonal, std::uint64_t host_limit) {
    const std::uint64_t face_limit = std::min(host_limit, kDefaultFaceBudget);
    double size = diagonal * kDefaultSizeShare;
    while (size < diagonal && predict_subdivision(mesh, size, face_limit) > face_limit) size *= kSizeGrowth;
    return size;
}

std::uint32_t default_faces(const TriangleMesh& mesh, double subdivision_size) {
    const double edge = kMeanEdgeOverSize * subdivision_size;
    const double faces = surface_area(mesh) / (kEquilateralArea * edge * edge);
    return static_cast<std::uint32_t>(std::clamp(faces, 4.0, 4e9));
}

}  // namespace

ImproveOptions default_options(const TriangleMesh& mesh, const ImproveOptions& options, const MethodLimits& limits) {
    const double diagonal = bounding_box(mesh).diagonal();
    ImproveOptions used = options;
    used.subdivision_size =
        options.subdivision_size ? *options.subdivision_size : default_subdivision_size(mesh, diagonal, limits.max_faces);
    used.tolerance = options.tolerance.value_or(kDefaultToleranceShare * diagonal);
    used.feature_detection = options.feature_detection.value_or(FeatureDetection::kDihedral);
    used.feature_angle = options.feature_angle.value_or(kDefaultFeatureAngle);
    used.feature_weight = options.feature_weight.value_or(kDefaultFeatureWeight);
    used.faces =
        options.faces ? *options.faces : std::max(default_faces(mesh, *used.subdivision_size), options.faces_min.value_or(4));
    used.faces_min = options.faces_min.value_or(kLeastFaces);
    used.mode = options.mode.value_or(Mode::kStrict);
    return used;
}

namespace {

Expected<MethodResult> improve_with(const TriangleMesh& mesh, const ImproveOptions& options, const MethodLimits& limits,
                                    const ExecutionContext& context) {
    const auto start = std::chrono::steady_clock::now();
    if (Status valid = check_options(options); !valid) return valid.error();
    context.report({"inspect", 0, mesh.face_count()});
    if (Status closed = require_closed_manifold(inspect(mesh)); !closed) return closed.error();
    if (Status fitting = check_options_on(mesh, options); !fitting) return fitting.error();
    ImproveOptions used = default_options(mesh, options, limits);

    Expected<SubdividedMesh> subdivided = subdivide_to_size(mesh, *used.subdivision_size, limits.max_faces, context);
    if (!subdivided) return subdivided.error();
    SimplifyInput input = prepare(mesh, std::move(*subdivided), {feature_options(used), *used.tolerance, *used.faces_min});
    Expected<MultiresMesh> mrr = simplify(std::move(input), ImprovePolicy{}, context);
    if (!mrr) return mrr.error();
    if (!options.faces) used.faces = std::max(*used.faces, kFacesOverCoarsest * mrr->faces_min());
    MethodResult result = describe_resolution(std::move(*mrr), *used.faces);
    if (!options.faces) used.faces = result.faces;
    result.options = used;
    result.elapsed = std::chrono::steady_clock::now() - start;
    return result;
}

}  // namespace

Expected<MethodResult> improve(const TriangleMesh& mesh, const ImproveOptions& options, const MethodLimits& limits,
                               const ExecutionContext& context) {
    return with_thread_limit(context, [&] { return improve_with(mesh, options, limits, context); });
}

}  // namespace vsplit
