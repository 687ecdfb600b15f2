#include "method/prepare.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "base/huge_pages.h"
#include "features/boundary_corners.h"
#include "mesh/boundary_loops.h"
#include "mesh/cap_boundaries.h"
#include "mesh/spatial_order.h"
#include "quality/deviation_of_index.h"
#include "vsplit/features/face_normals.h"
#include "vsplit/mrr/progressive_mesh.h"
#include "vsplit/quality/stretch.h"

namespace vsplit {
namespace {

/// Of faces, each that of its parent in `source`; in single precision, to be compared with others.
std::vector<Eigen::Vector3f> inherit(const FaceNormals& source, const std::vector<std::uint32_t>& parent) {
    std::vector<Eigen::Vector3f> normals;
    reserve_large(normals, parent.size());
    for (const std::uint32_t p : parent) normals.push_back(source.normals[p].cast<float>());
    return normals;
}

/// Planes of the faces, which lie in those of their parents, and lines of the sharp edges at each vertex ([Date05] 3.1).
std::vector<Quadric> vertex_quadrics(const SubdividedMesh& subdivided, const FaceNormals& source,
                                     const std::vector<SharpEdge>& creases, const Vec3& centre) {
    const TriangleMesh& mesh = subdivided.mesh;
    auto quadrics = large_vector<Quadric>(mesh.positions.size());
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        const Vec3& normal = source.normals[subdivided.parent[f]];
        for (const std::uint32_t v : mesh.faces[f]) quadrics[v] += Quadric::plane(normal, mesh.positions[v] - centre);
    }
    for (const SharpEdge& edge : creases) {
        const Vec3 a = mesh.positions[edge.a] - centre;
        const Vec3 b = mesh.positions[edge.b] - centre;
        if (a == b) continue;
        const Quadric line = Quadric::line((b - a).normalized(), a, edge.weight);
        quadrics[edge.a] += line;
        quadrics[edge.b] += line;
    }
    return quadrics;
}

/// Boundaries are held by their lines whatever creases weigh. Returns the creases, boundary edges at least so heavy.
std::vector<SharpEdge> with_heavy_boundary(std::vector<SharpEdge> creases, const TriangleMesh& mesh) {
    constexpr double kLeastWeight = 1;
    std::vector<std::uint32_t> after(mesh.positions.size(), kNone);
    for (const std::vector<HalfEdge>& loop : boundary_loops(mesh)) {
        for (const HalfEdge h : loop) after[origin(mesh, h)] = origin(mesh, next(h));
    }
    for (SharpEdge& edge : creases) {
        if (after[edge.a] == edge.b || after[edge.b] == edge.a) edge.weight = std::max(edge.weight, kLeastWeight);
    }
    return creases;
}

/// Closes boundaries by ghosts, which come first and have nothing of what other vertices and faces have.
void cap(SimplifyInput& input) {
    CappedMesh capped = cap_manifold(std::move(input.mesh));
    input.mesh = std::move(capped.mesh);
    input.ghosts = capped.ghosts;
    if (input.ghosts == 0) return;
    input.normals.resize(input.mesh.faces.size(), Eigen::Vector3f::Zero());
    input.quadrics.insert(input.quadrics.begin(), input.ghosts, Quadric{});
    if (!input.sizes.empty()) input.sizes.insert(input.sizes.begin(), input.ghosts, input.usual_size);
    for (std::uint32_t& corner : input.boundary_corners) corner += input.ghosts;
    for (SharpEdge& crease : input.creases) {
        crease.a += input.ghosts;
        crease.b += input.ghosts;
    }
}

/// A boundary that is rough by up to the tolerance has no corners; from this many tolerances away it looks straight.
constexpr double kCornerReach = 4;

}  // namespace

double slenderness(const TriangleMesh& mesh) {
    double squares = 0;
    for (const Triangle& t : mesh.faces) {
        const double size = face_size(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]);
        squares += size * size;
    }
    const double area = surface_area(mesh);
    return area > 0 ? squares / area : std::numeric_limits<double>::infinity();
}

double extent_of(const TriangleMesh& mesh) {
    const double diagonal = bounding_box(mesh).diagonal();
    const double area = surface_area(mesh);
    return area > 0 ? std::min(diagonal, 2 * std::sqrt(area)) : diagonal;
}

SimplifyInput prepare(const TriangleMesh& source, SubdividedMesh subdivided, const PrepareOptions& options) {
    const BoundingBox box = bounding_box(source);
    order_spatially(subdivided);
    const TriangleMesh& coarse = options.replaced ? options.replaced->mesh : source;
    const FaceNormals source_normals = face_normals(coarse);
    SimplifyInput input;
    input.centre = (box.min + box.max) / 2;
    input.creases =
        creases_on(subdivided, coarse,
                   options.replaced ? options.replaced->creases : find_creases(source, source_normals, options.features));
    if (!options.closed) {
        input.creases = with_heavy_boundary(std::move(input.creases), subdivided.mesh);
        input.boundary_corners = boundary_corners(subdivided.mesh, {options.features.angle, kCornerReach * options.tolerance});
        input.freeze_boundary = options.freeze_boundary;
    }
    input.quadrics = vertex_quadrics(subdivided, source_normals, input.creases, input.centre);
    if (options.sizes != nullptr) {
        input.sizes = allowed_sizes(subdivided, coarse, *options.sizes);
        input.usual_size = options.sizes->usual;
        input.sizes_bind = options.sizes->binding;
    }
    input.mesh = std::move(subdivided.mesh);
    input.normals = inherit(source_normals, subdivided.parent);
    input.crease_cosine = std::cos(options.features.angle * std::numbers::pi / 180);
    input.tolerance = options.tolerance;
    input.faces_min = options.faces_min;
    input.faces = options.faces;
    input.mean_floor = options.mean_floor;
    input.floor_from = options.floor_from;
    if (!options.closed) cap(input);
    return input;
}

namespace {

/// Long slivers lie in the boxes of all their neighbours, and an index over them is slow; that over their pieces is not.
bool has_needles(const TriangleMesh& mesh) {
    constexpr double kMuch = 100;
    return slenderness(mesh) > kMuch;
}

/// The same surface in smaller faces.
TriangleMesh without_needles(const TriangleMesh& mesh, const ExecutionContext& context) {
    constexpr double kShare = 0.015;
    constexpr double kGrowth = 1.25;
    constexpr std::uint32_t kMostFaces = 2'000'000;
    const double diagonal = bounding_box(mesh).diagonal();
    double size = kShare * diagonal;
    while (size < diagonal && predict_subdivision(mesh, size, kMostFaces, &context) > kMostFaces) size *= kGrowth;
    Expected<SubdividedMesh> fine = subdivide_to_size(mesh, size, std::max(kMostFaces, mesh.face_count()), context);
    if (!fine) return mesh;
    return std::move(fine->mesh);
}

}  // namespace

Reference reference_for(const TriangleMesh& source, const std::shared_ptr<const CreasedMesh>& replaced) {
    constexpr double kNothing = 1e-6;  // of the diagonal
    const bool usable = replaced && replaced->moved <= kNothing * bounding_box(source).diagonal();
    return usable && has_needles(source) ? Reference{replaced->mesh, replaced->moved} : Reference{source, 0};
}

Status guard(SimplifyInput& input, const Reference& reference, double distance, const ExecutionContext& context) {
    const TriangleMesh& mesh = reference.mesh;
    const TriangleMesh pieces = has_needles(mesh) ? without_needles(mesh, context) : TriangleMesh();
    if (context.cancelled()) return ExecutionContext::cancelled_error();
    input.source = std::make_shared<const SurfaceIndex>(surface_index(pieces.faces.empty() ? mesh : pieces));
    input.max_deviation = distance - reference.moved;
    return Done{};
}

namespace {

void show(MethodResult& result, std::size_t level, const TriangleMesh& mesh, double deviation) {
    if (result.faces != result.mrr.faces_at(level)) {
        result.faces = result.mrr.faces_at(level);
        result.quality = measure_quality(mesh);
    }
    result.quality.deviation_max = deviation;
}

}  // namespace

DeviationOptions accuracy_for(std::optional<double> limit, double diagonal) {
    DeviationOptions options;
    if (!limit) return options;
    options.relative_error = 0.01;
    options.absolute_error = std::min(0.01 * *limit, 1e-5 * diagonal);
    return options;
}

Status measure(MethodResult& result, const Reference& reference, const SurfaceIndex* reference_index, std::optional<double> limit,
               bool may_refine, const ExecutionContext& context) {
    if (reference_index == nullptr) return Done{};
    const TriangleMesh& source = reference.mesh;
    const DeviationOptions options = accuracy_for(limit, bounding_box(source).diagonal());
    std::size_t level = result.mrr.level_for(result.faces);
    for (;;) {
        const TriangleMesh mesh = mesh_at(result.mrr, level);
        const SurfaceIndex index = surface_index(mesh);
        const Expected<Deviation> deviation = measure_deviation({mesh, index}, {source, *reference_index}, options, context);
        if (!deviation) return deviation.error();
        const double most = deviation->max() + reference.moved;
        show(result, level, mesh, most);
        const bool kept = !limit || most <= *limit;
        if (kept || !may_refine || level == result.mrr.levels()) return Done{};
        level = std::min(result.mrr.levels(), level + std::max<std::size_t>(1, result.mrr.levels() / 10));
    }
}

namespace {

/// A violation of max_deviation where `measured` is more than `limit`.
void report_over(MethodResult& result, std::optional<double> measured, std::optional<double> limit, const char* reason) {
    if (!limit || !measured || *measured <= *limit) return;
    Violation violation;
    violation.bound = "max_deviation";
    violation.limit = *limit;
    violation.worst = *measured;
    violation.count = 1;
    violation.reason = reason;
    result.violations.push_back(std::move(violation));
}

}  // namespace

void report_deviation(MethodResult& result, std::optional<double> limit) {
    report_over(result, result.quality.deviation_max, limit,
                "no resolution keeps to it; a larger length is met, or a smaller subdivision size meets this one");
    report_over(
        result, result.quality.crease_deviation_max, limit,
        "some crease of the source is further from all of the result's; a larger length is met, or more faces meet this one");
}

void report_sizes(MethodResult& result, const TriangleMesh& source, const SizePlan& plan) {
    const TriangleMesh shown = mesh_at(result.mrr, result.mrr.level_for(result.faces));
    if (std::optional<Violation> oversized = find_oversized(shown, source, plan))
        result.violations.push_back(*std::move(oversized));
}

MethodResult describe_resolution(MultiresMesh mrr, std::uint32_t faces) {
    MethodResult result;
    const std::size_t level = mrr.level_for(faces);
    result.faces = mrr.faces_at(level);
    result.faces_subdivided = mrr.faces_max();
    result.quality = measure_quality(mesh_at(mrr, level));
    result.mrr = std::move(mrr);
    return result;
}

}  // namespace vsplit
