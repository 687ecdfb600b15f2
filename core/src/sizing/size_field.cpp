#include "vsplit/sizing/size_field.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "base/number_text.h"
#include "features/neighbourhood.h"
#include "subdivide/face_limit.h"
#include "subdivide/midpoints.h"

namespace vsplit {
namespace {

constexpr double kNoBound = std::numeric_limits<double>::infinity();

/// What the field says of a vertex while a mesh is subdivided. The linear part needs no parent: the middle of two points of one
/// face has the mean of their sizes.
struct FieldSize {
    struct Point {
        Vec3 p;
        double linear = 0;
        double size = 0;
    };

    const SizeField& field;
    double least = 0;  ///< no size is below this

    [[nodiscard]] Point point(const Vec3& p, double linear) const {
        return {p, linear, std::max(least, std::min(linear, field.size_of_shapes(p)))};
    }
    [[nodiscard]] Point midpoint(const Point& a, const Point& b) const {
        return point((a.p + b.p) * 0.5, (a.linear + b.linear) / 2);
    }
    [[nodiscard]] static bool wants(const Point& a, const Point& b) { return (a.p - b.p).norm() > std::min(a.size, b.size); }
};

auto point_of(const TriangleMesh& mesh, const FieldSize& rule) {
    return [&mesh, &rule](std::uint32_t v) { return rule.point(mesh.positions[v], rule.field.vertex_sizes()[v]); };
}

std::uint64_t predict_with(const TriangleMesh& mesh, const FieldSize& rule, std::uint64_t limit,
                           const ExecutionContext* context) {
    return count_pieces(mesh, rule, point_of(mesh, rule), limit, context);
}

double fitting_min_size(const TriangleMesh& mesh, const SizeField& field, std::uint64_t limit, const ExecutionContext& context) {
    return fitting_length(bounding_box(mesh).diagonal(), limit, [&](double least) {
        return predict_with(mesh, {field, least}, limit, &context);
    });
}

/// Shares of the corners of a face in a point of it, by least squares; from 0, sum 1. A face without area counts as its longest
/// edge.
std::array<double, 3> shares(const std::array<Vec3, 3>& face, const Vec3& point) {
    const Vec3 normal = (face[1] - face[0]).cross(face[2] - face[0]);
    std::array<double, 3> share{};
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        share[i] = std::max(0.0, (face[(i + 1) % 3] - point).cross(face[(i + 2) % 3] - point).dot(normal));
        sum += share[i];
    }
    if (sum > 0) {
        for (double& s : share) s /= sum;
        return share;
    }
    std::size_t start = 0;
    const auto length = [&](std::size_t i) { return (face[(i + 1) % 3] - face[i]).norm(); };
    for (std::size_t i = 1; i < 3; ++i) start = length(i) > length(start) ? i : start;
    const Vec3 way = face[(start + 1) % 3] - face[start];
    const double along = length(start) > 0 ? std::clamp((point - face[start]).dot(way) / way.squaredNorm(), 0.0, 1.0) : 0.5;
    share[start] = 1 - along;
    share[(start + 1) % 3] = along;
    return share;
}

double linear_size(const TriangleMesh& source, const std::vector<double>& sizes, std::uint32_t face, const Vec3& point) {
    const Triangle& t = source.faces[face];
    const auto share = shares({source.positions[t[0]], source.positions[t[1]], source.positions[t[2]]}, point);
    double size = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        if (share[i] > 0) size += share[i] * sizes[t[i]];
    }
    return size;
}

/// What each vertex is asked for by itself, before gradation.
std::vector<double> asked_sizes(const TriangleMesh& mesh, const SizingOptions& options, const std::vector<SharpEdge>& creases) {
    std::vector<double> sizes(mesh.positions.size(), options.max_size.value_or(kNoBound));
    for (std::size_t v = 0; v < options.field.size(); ++v) {
        if (options.field[v] > 0) sizes[v] = std::min(sizes[v], options.field[v]);
    }
    if (!options.chord_error) return sizes;
    const double error = *options.chord_error;
    const std::vector<double> curvature = largest_curvature(mesh, creases);
    for (std::size_t v = 0; v < sizes.size(); ++v) {
        // What is rounder than the error is within it anyway; below that curvature is mostly rounding of tiny edges.
        const double radius = std::max(1 / curvature[v], error);
        sizes[v] = std::min(sizes[v], std::sqrt(8 * radius * error));
    }
    return sizes;
}

double distance_to(const SizeSphere& sphere, const Vec3& point) {
    return std::max(0.0, (point - sphere.center).norm() - sphere.radius);
}

double distance_to(const SizeBox& box, const Vec3& point) {
    return (box.min - point).cwiseMax(point - box.max).cwiseMax(Vec3::Zero()).norm();
}

template <class Shape>
double size_of(const std::vector<Shape>& shapes, double gradation, const Vec3& point) {
    double size = kNoBound;
    for (const Shape& shape : shapes) size = std::min(size, shape.size + gradation * distance_to(shape, point));
    return size;
}

}  // namespace

double SizeField::size_of_shapes(const Vec3& point) const {
    return std::min(size_of(spheres_, gradation_, point), size_of(boxes_, gradation_, point));
}

Expected<SizeField> make_size_field(const TriangleMesh& mesh, const SizingOptions& options,
                                    const std::vector<SharpEdge>& creases) {
    if (Status s = check_sizing(options); !s) return s.error();
    if (Status s = check_sizing_on(mesh, options); !s) return s.error();
    const double least = options.min_size.value_or(0);
    SizeField field;
    field.gradation_ = options.gradation;
    field.spheres_ = options.spheres;
    field.boxes_ = options.boxes;
    for (SizeSphere& sphere : field.spheres_) sphere.size = std::max(sphere.size, least);
    for (SizeBox& box : field.boxes_) box.size = std::max(box.size, least);
    std::vector<double> sizes = asked_sizes(mesh, options, creases);
    for (std::size_t v = 0; v < sizes.size(); ++v) {
        sizes[v] = std::min(std::max(sizes[v], least), field.size_of_shapes(mesh.positions[v]));
    }
    field.vertex_sizes_ = graded_sizes(mesh, std::move(sizes), options.gradation);
    return field;
}

std::vector<double> sizes_on(const SubdividedMesh& fine, const TriangleMesh& source, const SizeField& field) {
    std::vector<double> sizes(fine.mesh.positions.size(), kNoBound);
    for (std::uint32_t f = 0; f < fine.mesh.face_count(); ++f) {
        // Faces on either side of an edge agree but for rounding; the least of them does not depend on their order.
        for (const std::uint32_t v : fine.mesh.faces[f]) {
            sizes[v] = std::min(sizes[v], linear_size(source, field.vertex_sizes(), fine.parent[f], fine.mesh.positions[v]));
        }
    }
    for (std::size_t v = 0; v < sizes.size(); ++v) sizes[v] = std::min(sizes[v], field.size_of_shapes(fine.mesh.positions[v]));
    return graded_sizes(fine.mesh, std::move(sizes), field.gradation());
}

double size_at(const TriangleMesh& source, const SizeField& field, std::uint32_t face, const Vec3& point) {
    return std::min(linear_size(source, field.vertex_sizes(), face, point), field.size_of_shapes(point));
}

std::vector<double> graded_sizes(const TriangleMesh& mesh, std::vector<double> sizes, double gradation) {
    using Entry = std::pair<double, std::uint32_t>;
    const auto later = [](const Entry& left, const Entry& right) { return left > right; };
    const VertexCorners corners(mesh);
    std::vector<Entry> heap;
    for (std::uint32_t v = 0; v < sizes.size(); ++v) {
        if (sizes[v] < kNoBound) heap.emplace_back(sizes[v], v);
    }
    std::make_heap(heap.begin(), heap.end(), later);
    while (!heap.empty()) {
        std::pop_heap(heap.begin(), heap.end(), later);
        const auto [size, v] = heap.back();
        heap.pop_back();
        if (size > sizes[v]) continue;
        for (const HalfEdge h : corners.at(v)) {
            for (const HalfEdge g : {next(h), prev(h)}) {
                const std::uint32_t other = origin(mesh, g);
                const double reach = size + gradation * (mesh.positions[other] - mesh.positions[v]).norm();
                if (reach >= sizes[other]) continue;
                sizes[other] = reach;
                heap.emplace_back(reach, other);
                std::push_heap(heap.begin(), heap.end(), later);
            }
        }
    }
    return sizes;
}

std::uint64_t predict_subdivision(const TriangleMesh& mesh, const SizeField& field, std::uint64_t limit,
                                  const ExecutionContext* context) {
    return predict_with(mesh, {field, 0}, limit, context);
}

Expected<SubdividedMesh> subdivide_to_sizes(const TriangleMesh& mesh, const SizeField& field, const FaceLimit& limit,
                                            const ExecutionContext& context) {
    if (Status fits = check_subdivision_to_sizes(mesh, limit.most); !fits) return fits.error();
    const FieldSize rule{field, 0};
    const std::uint64_t predicted = predict_with(mesh, rule, limit.most, &context);
    if (predicted > limit.most) {
        const double fitting = fitting_min_size(mesh, field, limit.most, context);
        if (context.cancelled()) return ExecutionContext::cancelled_error();
        return too_many_faces_of_sizes(limit.most, fitting);
    }
    if (context.cancelled()) return ExecutionContext::cancelled_error();
    if (Status may = limit.check(predicted); !may) return may.error();
    return subdivide_by(mesh, rule, point_of(mesh, rule), predicted, context);
}

}  // namespace vsplit
