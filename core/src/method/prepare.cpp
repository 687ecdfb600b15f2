#include "method/prepare.h"

#include <algorithm>
#include <utility>

#include "mesh/spatial_order.h"
#include "quality/deviation_of_index.h"
#include "vsplit/features/face_normals.h"
#include "vsplit/mrr/progressive_mesh.h"
#include "vsplit/quality/stretch.h"

namespace vsplit {
namespace {

FaceNormals inherit(const FaceNormals& source, const std::vector<std::uint32_t>& parent) {
    FaceNormals result;
    result.normals.reserve(parent.size());
    result.reliable.reserve(parent.size());
    for (const std::uint32_t p : parent) {
        result.normals.push_back(source.normals[p]);
        result.reliable.push_back(source.reliable[p]);
    }
    return result;
}

/// Planes of the faces and lines of the sharp edges at each vertex ([Date05] 3.1).
std::vector<Quadric> vertex_quadrics(const TriangleMesh& mesh, const FaceNormals& normals, const std::vector<SharpEdge>& creases,
                                     const Vec3& centre) {
    std::vector<Quadric> quadrics(mesh.positions.size());
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        for (const std::uint32_t v : mesh.faces[f]) {
            quadrics[v] += Quadric::plane(normals.normals[f], mesh.positions[v] - centre);
        }
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

}  // namespace

SimplifyInput prepare(const TriangleMesh& source, SubdividedMesh subdivided, const PrepareOptions& options) {
    const BoundingBox box = bounding_box(source);
    order_spatially(subdivided);
    const TriangleMesh& coarse = options.mended ? options.mended->mesh : source;
    const FaceNormals source_normals = face_normals(coarse);
    FaceNormals normals = inherit(source_normals, subdivided.parent);
    SimplifyInput input;
    input.centre = (box.min + box.max) / 2;
    input.creases = creases_on(subdivided, coarse,
                               options.mended ? options.mended->creases : find_creases(source, source_normals, options.features));
    input.quadrics = vertex_quadrics(subdivided.mesh, normals, input.creases, input.centre);
    input.mesh = std::move(subdivided.mesh);
    input.normals = std::move(normals.normals);
    input.tolerance = options.tolerance;
    input.faces_min = options.faces_min;
    input.faces = options.faces;
    return input;
}

namespace {

/// Long slivers lie in the boxes of all their neighbours, and an index over them is slow; that over their pieces is not.
bool has_needles(const TriangleMesh& mesh) {
    constexpr double kMuch = 100;  // 2.3 where all are equilateral
    double squares = 0;
    for (const Triangle& t : mesh.faces) {
        const double size = face_size(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]);
        squares += size * size;
    }
    return squares > kMuch * surface_area(mesh);
}

}  // namespace

void guard(SimplifyInput& input, const TriangleMesh& source, double distance) {
    input.source = std::make_shared<const SurfaceIndex>(surface_index(has_needles(source) ? input.mesh : source));
    input.max_deviation = distance;
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

Status measure(MethodResult& result, const TriangleMesh& source, const SurfaceIndex* source_index, std::optional<double> limit,
               bool may_refine, const ExecutionContext& context) {
    if (source_index == nullptr) return Done{};
    DeviationOptions options;
    if (limit) {
        // The upper bound is what counts, and a bound may be far below the default error.
        options.relative_error = 0.01;
        options.absolute_error = std::min(0.01 * *limit, 1e-5 * bounding_box(source).diagonal());
    }
    std::size_t level = result.mrr.level_for(result.faces);
    for (;;) {
        const TriangleMesh mesh = mesh_at(result.mrr, level);
        const SurfaceIndex index = surface_index(mesh);
        const Expected<Deviation> deviation = measure_deviation({mesh, index}, {source, *source_index}, options, context);
        if (!deviation) return deviation.error();
        show(result, level, mesh, deviation->max());
        const bool kept = !limit || deviation->max() <= *limit;
        if (kept || !may_refine || level == result.mrr.levels()) return Done{};
        level = std::min(result.mrr.levels(), level + std::max<std::size_t>(1, result.mrr.levels() / 10));
    }
}

void report_deviation(MethodResult& result, std::optional<double> limit) {
    const std::optional<double> measured = result.quality.deviation_max;
    if (!limit || !measured || *measured <= *limit) return;
    Violation violation;
    violation.bound = "max_deviation";
    violation.limit = *limit;
    violation.worst = *measured;
    violation.count = 1;
    violation.reason = "no resolution keeps to it; a larger length is met, or a smaller subdivision size meets this one";
    result.violations.push_back(std::move(violation));
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
