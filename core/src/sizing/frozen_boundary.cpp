#include "sizing/frozen_boundary.h"

#include <algorithm>
#include <string>

#include "mesh/boundary_loops.h"
#include "subdivide/face_limit.h"
#include "subdivide/midpoints.h"
#include "vsplit/sizing/size_field.h"

namespace vsplit {
namespace {

/// How fast sizes fall off from an edge that may not be split.
constexpr double kGradation = 0.5;

/// An edge is split when it is longer than the size at either end, unless it is of the boundary. A midpoint's size follows from
/// those of the ends, so that it is the same in both faces.
struct InsideSize {
    struct Point {
        Vec3 p;
        double size = 0;
        std::uint32_t source = kNone;  // the vertex of the source it is
        double linear = 0;             // what the field says there but for its shapes

        [[nodiscard]] double allowed(const SizeField* shapes) const {
            return shapes == nullptr ? size : std::max(size, std::min(linear, shapes->size_of_shapes(p)));
        }
    };

    double max_edge = 0;               // no size is less
    std::vector<std::uint32_t> after;  // of a vertex of the source: the next one along its boundary, or kNone
    std::vector<double> sizes;         // of a vertex of the source
    const SizeField* field = nullptr;  // what is allowed beside `sizes`, if anything

    /// Sizes of the mesh's vertices: the longest boundary edge there, falling off along edges.
    InsideSize(const TriangleMesh& mesh, double least)
        : max_edge(least), after(mesh.positions.size(), kNone), sizes(mesh.positions.size(), least) {
        double longest = least;
        for (const std::vector<HalfEdge>& loop : boundary_loops(mesh)) {
            for (const HalfEdge h : loop) {
                const std::uint32_t a = origin(mesh, h), b = origin(mesh, next(h));
                const double length = (mesh.positions[b] - mesh.positions[a]).norm();
                after[a] = b;
                for (const std::uint32_t v : {a, b}) sizes[v] = std::max(sizes[v], length);
                longest = std::max(longest, length);
            }
        }
        // What graded_sizes brings down, seen upside down: the least sizes that nowhere fall off faster.
        const auto turn_over = [&] {
            for (double& size : sizes) size = longest - size;
        };
        turn_over();
        sizes = graded_sizes(mesh, std::move(sizes), kGradation);
        turn_over();
        for (double& size : sizes) size = std::max(size, least);
    }

    [[nodiscard]] Point point(const TriangleMesh& mesh, std::uint32_t v) const {
        return {mesh.positions[v], sizes[v], v, field == nullptr ? 0 : field->vertex_sizes()[v]};
    }
    [[nodiscard]] Point midpoint(const Point& a, const Point& b) const {
        const double way = (a.p - b.p).norm() / 2;
        return {(a.p + b.p) * 0.5, std::max(max_edge, std::max(a.size, b.size) - kGradation * way), kNone,
                (a.linear + b.linear) / 2};
    }
    [[nodiscard]] bool wants(const Point& a, const Point& b) const {
        return !is_boundary(a.source, b.source) && (a.p - b.p).norm() > std::min(a.allowed(field), b.allowed(field));
    }
    [[nodiscard]] bool is_boundary(std::uint32_t a, std::uint32_t b) const {
        return a != kNone && b != kNone && (after[a] == b || after[b] == a);
    }
};

auto point_of(const TriangleMesh& mesh, const InsideSize& rule) {
    return [&](std::uint32_t v) { return rule.point(mesh, v); };
}

/// With no size under `least`; `field`: null for none.
std::uint64_t predict_inside(const TriangleMesh& mesh, double least, const SizeField* field, std::uint64_t limit,
                             const ExecutionContext* context) {
    InsideSize rule(mesh, least);
    rule.field = field;
    return count_pieces(mesh, rule, point_of(mesh, rule), limit, context);
}

double fitting_inside(const TriangleMesh& mesh, const SizeField* field, std::uint64_t limit, const ExecutionContext& context) {
    return fitting_length(bounding_box(mesh).diagonal(), limit,
                          [&](double least) { return predict_inside(mesh, least, field, limit, &context); });
}

}  // namespace

Expected<SubdividedMesh> subdivide_to_size_inside(const TriangleMesh& mesh, double max_edge, const FaceLimit& limit,
                                                  const ExecutionContext& context) {
    if (Status valid = check_subdivision(mesh, max_edge, limit.most); !valid) return valid.error();
    const InsideSize rule(mesh, max_edge);
    const std::uint64_t predicted = count_pieces(mesh, rule, point_of(mesh, rule), limit.most, &context);
    if (context.cancelled()) return ExecutionContext::cancelled_error();
    if (predicted > limit.most) {
        const double fitting = fitting_inside(mesh, nullptr, limit.most, context);
        if (context.cancelled()) return ExecutionContext::cancelled_error();
        return too_many_faces(max_edge, limit.most, fitting);
    }
    if (Status may = limit.check(predicted); !may) return may.error();
    return subdivide_by(mesh, rule, point_of(mesh, rule), predicted, context);
}

Expected<SubdividedMesh> subdivide_to_sizes_inside(const TriangleMesh& mesh, const SizeField& field, const FaceLimit& limit,
                                                   const ExecutionContext& context) {
    if (Status fits = check_subdivision_to_sizes(mesh, limit.most); !fits) return fits.error();
    InsideSize rule(mesh, 0);
    rule.field = &field;
    const std::uint64_t predicted = count_pieces(mesh, rule, point_of(mesh, rule), limit.most, &context);
    if (context.cancelled()) return ExecutionContext::cancelled_error();
    if (predicted > limit.most) {
        const double fitting = fitting_inside(mesh, &field, limit.most, context);
        if (context.cancelled()) return ExecutionContext::cancelled_error();
        return too_many_faces_of_sizes(limit.most, fitting);
    }
    if (Status may = limit.check(predicted); !may) return may.error();
    return subdivide_by(mesh, rule, point_of(mesh, rule), predicted, context);
}

Expected<SubdividedMesh> subdivide_one_to_four_inside(const TriangleMesh& mesh, std::uint32_t times, const FaceLimit& limit,
                                                      const ExecutionContext& context) {
    if (Status valid = check_times(mesh, times, limit.most); !valid) return valid.error();
    // Edges of the boundary stay, so it will be fewer.
    if (Status may = limit.check(std::uint64_t{mesh.face_count()} << (2 * times)); !may) return may.error();
    const InsideSize rule(mesh, 0);
    auto current = start_subdivision<InsideSize>(mesh, point_of(mesh, rule));
    for (std::uint32_t round = 0; round < times; ++round) {
        if (context.cancelled()) return ExecutionContext::cancelled_error();
        context.report({"subdivide", static_cast<double>(round) / times, static_cast<std::uint32_t>(current.faces.size())});
        subdivide_round(current, rule);
    }
    return finish_subdivision(std::move(current));
}

}  // namespace vsplit
