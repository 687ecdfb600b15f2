#include "vsplit/subdivide/subdivide.h"

#include "subdivide/face_limit.h"
#include "subdivide/midpoints.h"
#include "vsplit/quality/stretch.h"

namespace vsplit {
namespace {

Vec3 middle_of(const Vec3& a, const Vec3& b) { return (a + b) * 0.5; }

/// The same size everywhere.
struct UniformSize {
    struct Point {
        Vec3 p;
    };

    double max_edge = 0;

    [[nodiscard]] static Point midpoint(const Point& a, const Point& b) { return {middle_of(a.p, b.p)}; }
    [[nodiscard]] bool wants(const Point& a, const Point& b) const { return (a.p - b.p).squaredNorm() > max_edge * max_edge; }
};

/// Every edge, once a round.
struct EveryEdge {
    using Point = UniformSize::Point;

    [[nodiscard]] static Point midpoint(const Point& a, const Point& b) { return UniformSize::midpoint(a, b); }
    [[nodiscard]] static bool wants(const Point&, const Point&) { return true; }
};

auto point_of(const TriangleMesh& mesh) {
    return [&mesh](std::uint32_t v) { return UniformSize::Point{mesh.positions[v]}; };
}

/// The smallest max_edge, within a fifth, that keeps to the limit.
double fitting_max_edge(const TriangleMesh& mesh, std::uint64_t limit, const ExecutionContext& context) {
    return fitting_length(bounding_box(mesh).diagonal(), limit,
                          [&](double max_edge) { return predict_subdivision(mesh, max_edge, limit, &context); });
}

/// Faces are in the region of the face they lie in.
SubdividedMesh with_regions(const TriangleMesh& source, SubdividedMesh fine) {
    if (source.regions.size() != source.faces.size()) return fine;
    for (const std::uint32_t parent : fine.parent) fine.mesh.regions.push_back(source.regions[parent]);
    fine.mesh.sets = source.sets;
    return fine;
}

}  // namespace

std::uint64_t predict_subdivision(const TriangleMesh& mesh, double max_edge, std::uint64_t limit,
                                  const ExecutionContext* context) {
    // No piece has more area than the equilateral triangle of that edge, so far too many need not be counted.
    if (surface_area(mesh) > 1.01 * kEquilateralArea * max_edge * max_edge * static_cast<double>(limit)) return limit + 1;
    return count_pieces(mesh, UniformSize{max_edge}, point_of(mesh), limit, context);
}

Expected<SubdividedMesh> subdivide_to_size(const TriangleMesh& mesh, double max_edge, const FaceLimit& limit,
                                           const ExecutionContext& context) {
    if (Status valid = check_subdivision(mesh, max_edge, limit.most); !valid) return valid.error();
    const std::uint64_t predicted = predict_subdivision(mesh, max_edge, limit.most, &context);
    const double fitting = predicted > limit.most ? fitting_max_edge(mesh, limit.most, context) : max_edge;
    if (context.cancelled()) return ExecutionContext::cancelled_error();
    if (predicted > limit.most) return too_many_faces(max_edge, limit.most, fitting);
    if (Status may = limit.check(predicted); !may) return may.error();
    Expected<SubdividedMesh> fine = subdivide_by(mesh, UniformSize{max_edge}, point_of(mesh), predicted, context);
    if (!fine) return fine;
    return with_regions(mesh, *std::move(fine));
}

Expected<SubdividedMesh> subdivide_one_to_four(const TriangleMesh& mesh, std::uint32_t times, const FaceLimit& limit,
                                               const ExecutionContext& context) {
    if (Status valid = check_times(mesh, times, limit.most); !valid) return valid.error();
    if (Status may = limit.check(std::uint64_t{mesh.face_count()} << (2 * times)); !may) return may.error();
    auto current = start_subdivision<EveryEdge>(mesh, point_of(mesh));
    for (std::uint32_t round = 0; round < times; ++round) {
        if (context.cancelled()) return ExecutionContext::cancelled_error();
        context.report({"subdivide", static_cast<double>(round) / times, static_cast<std::uint32_t>(current.faces.size())});
        subdivide_round(current, EveryEdge{});
    }
    return with_regions(mesh, finish_subdivision(std::move(current)));
}

}  // namespace vsplit
