#include "method/size_plan.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "spatial/surface_index.h"
#include "vsplit/quality/stretch.h"

namespace vsplit {
namespace {

constexpr double kChordShare = 2;    // of the tolerance: what max_deviation is by default
constexpr double kLeastShare = 0.3;  // of the usual size
constexpr double kGrowth = 1.25;

double mean_of(const std::vector<double>& sizes, const Triangle& t) { return (sizes[t[0]] + sizes[t[1]] + sizes[t[2]]) / 3; }

}  // namespace

Expected<SizePlan> plan_sizes(const TriangleMesh& mesh, const SizingOptions& sizing, const std::vector<SharpEdge>& creases,
                              double usual) {
    Expected<SizeField> field = make_size_field(mesh, sizing, creases);
    if (!field) return field.error();
    return SizePlan{*std::move(field), usual, true};
}

SizingOptions with_field_on(const TriangleMesh& mended, const TriangleMesh& mesh, SizingOptions sizing) {
    SizingOptions given;  // what bounds sizes beside it is found on `mended` itself
    given.field = sizing.field;
    given.gradation = sizing.gradation;
    const Expected<SizeField> field = make_size_field(mesh, given, {});
    if (!field) return sizing;
    const SurfaceIndex index = surface_index(mesh);
    for (std::size_t v = mesh.positions.size(); v < mended.positions.size(); ++v) {
        const Vec3& p = mended.positions[v];
        const double size = size_at(mesh, *field, index.closest(p).element, p);
        sizing.field.push_back(std::isfinite(size) ? size : 0);
    }
    return sizing;
}

Expected<SizePlan> plan_by_curvature(const TriangleMesh& mesh, const std::vector<SharpEdge>& creases, double tolerance,
                                     double usual, std::uint32_t face_budget, const ExecutionContext& context) {
    SizingOptions sizing;
    sizing.chord_error = kChordShare * tolerance;
    sizing.max_size = usual;
    for (double least = kLeastShare * usual;; least *= kGrowth) {
        sizing.min_size = std::min(least, usual);
        Expected<SizeField> field = make_size_field(mesh, sizing, creases);
        if (!field) return field.error();
        if (context.cancelled()) return ExecutionContext::cancelled_error();
        if (least >= usual || predict_subdivision(mesh, *field, face_budget, &context) <= face_budget) {
            return SizePlan{*std::move(field), usual, false};
        }
    }
}

std::vector<double> allowed_sizes(const SubdividedMesh& fine, const TriangleMesh& source, const SizePlan& plan) {
    return sizes_on(fine, source, plan.field);
}

double wanted_faces(const SubdividedMesh& fine, const TriangleMesh& source, const SizePlan& plan) {
    std::vector<double> wanted = allowed_sizes(fine, source, plan);
    for (double& size : wanted) size = std::min(size, plan.usual);
    double faces = 0;
    for (const Triangle& t : fine.mesh.faces) {
        const Vec3& a = fine.mesh.positions[t[0]];
        const double area = (fine.mesh.positions[t[1]] - a).cross(fine.mesh.positions[t[2]] - a).norm() / 2;
        const double size = mean_of(wanted, t);
        faces += area / (kEquilateralArea * size * size);
    }
    return faces;
}

std::optional<Violation> find_oversized(const TriangleMesh& result, const TriangleMesh& source, const SizePlan& plan) {
    if (!plan.binding) return std::nullopt;
    const SurfaceIndex index = surface_index(source);
    std::vector<double> allowed;
    allowed.reserve(result.positions.size());
    for (const Vec3& p : result.positions) allowed.push_back(size_at(source, plan.field, index.closest(p).element, p));
    Violation violation;
    violation.bound = "sizing";
    violation.limit = violation.worst = 1;
    for (std::uint32_t f = 0; f < result.face_count(); ++f) {
        const Triangle& t = result.faces[f];
        double ratio = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t a = t[i], b = t[(i + 1) % 3];
            ratio = std::max(ratio, (result.positions[a] - result.positions[b]).norm() / std::min(allowed[a], allowed[b]));
        }
        if (!(ratio > 1)) continue;
        violation.worst = std::max(violation.worst, ratio);
        if (violation.count++ < Violation::kMostElements) violation.elements.push_back(f);
    }
    if (violation.count == 0) return std::nullopt;
    violation.reason =
        "worst is the longest edge over what its ends allow; a boundary that is frozen keeps its edges, and where sizes grow "
        "fast a vertex that moves may be a little late: a smaller size, or a smaller gradation, meets it";
    return violation;
}

}  // namespace vsplit
