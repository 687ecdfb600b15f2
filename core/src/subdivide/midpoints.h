#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "mesh/half_edges.h"
#include "vsplit/subdivide/subdivide.h"

/// Selective midpoint subdivision ([Date05] Fig. 6) by any rule. A Rule says what it must know of a vertex and which edges it
/// wants cut:
///
///     struct Rule {
///         struct Point { Vec3 p; ... };
///         Point midpoint(const Point& a, const Point& b) const;  // the same for (b, a)
///         bool wants(const Point& a, const Point& b) const;      // the same for (b, a)
///     };
namespace vsplit {

/// The rules of Fig. 6 in one place. Vertices are given as corners 0, 1, 2 and edge midpoints 3 (of 0-1), 4 (of 1-2), 5 (of 2-0);
/// emits the child triangles. `first_diagonal_shorter(a, b, c, d)` says whether a-c is at most as long as b-d in quad a, b, c, d.
template <class Shorter, class Emit>
void cut_face(const std::array<bool, 3>& marked, Shorter first_diagonal_shorter, Emit emit) {
    const int count = int{marked[0]} + int{marked[1]} + int{marked[2]};
    if (count == 0) return emit(0, 1, 2);
    if (count == 3) {
        emit(0, 3, 5);
        emit(1, 4, 3);
        emit(2, 5, 4);
        return emit(3, 4, 5);
    }
    // Turn the face so that the odd edge out (the one marked, or the one not marked) is edge 0 = (a, b).
    const int odd = static_cast<int>(std::find(marked.begin(), marked.end(), count == 1) - marked.begin());
    const int a = odd, b = (odd + 1) % 3, c = (odd + 2) % 3;
    const int mid_ab = 3 + odd, mid_bc = 3 + b, mid_ca = 3 + c;
    if (count == 1) {
        emit(a, mid_ab, c);
        return emit(mid_ab, b, c);
    }
    emit(mid_ca, mid_bc, c);
    if (first_diagonal_shorter(a, b, mid_bc, mid_ca)) {
        emit(a, b, mid_bc);
        emit(a, mid_bc, mid_ca);
    } else {
        emit(a, b, mid_ca);
        emit(b, mid_bc, mid_ca);
    }
}

/// Counts the faces each face ends as. Depth-first with an explicit stack: its depth is the logarithm of the edge over its size.
template <class Rule>
class PieceCounter {
public:
    using Point = typename Rule::Point;
    using Face = std::array<Point, 3>;

    PieceCounter(const Rule& rule, std::uint64_t limit, const ExecutionContext* context)
        : rule_(rule), limit_(limit), context_(context) {}

    /// More than the limit in all, or cancelled.
    [[nodiscard]] bool over() const { return pieces_ > limit_; }
    [[nodiscard]] std::uint64_t pieces() const { return pieces_; }

    void add(const Face& face) {
        cut(face);
        while (!open_.empty() && pieces_ + open_.size() <= limit_) {
            const Face f = open_.back();
            open_.pop_back();
            cut(f);
            if (++cuts_ % 4096 == 0 && context_ != nullptr && context_->cancelled()) pieces_ = limit_ + 1;
        }
        pieces_ += open_.size();
        open_.clear();
    }

private:
    void cut(const Face& f) {
        const std::array<bool, 3> marked{rule_.wants(f[0], f[1]), rule_.wants(f[1], f[2]), rule_.wants(f[2], f[0])};
        if (!marked[0] && !marked[1] && !marked[2]) {
            ++pieces_;
            return;
        }
        std::array<Point, 6> points{f[0], f[1], f[2], f[0], f[0], f[0]};
        for (std::size_t i = 0; i < 3; ++i) {
            if (marked[i]) points[3 + i] = rule_.midpoint(f[i], f[(i + 1) % 3]);
        }
        const auto shorter = [&](int a, int b, int c, int d) {
            return (points[a].p - points[c].p).squaredNorm() <= (points[b].p - points[d].p).squaredNorm();
        };
        cut_face(marked, shorter, [&](int a, int b, int c) { open_.push_back({points[a], points[b], points[c]}); });
    }

    const Rule& rule_;
    std::uint64_t limit_;
    const ExecutionContext* context_;
    std::uint64_t pieces_ = 0;
    std::uint64_t cuts_ = 0;
    std::vector<Face> open_;
};

/// Faces that `rule` makes of those of `mesh`, or `limit` + 1 when they are more, or when `context` is cancelled.
/// `point(v)` is what the rule knows of a vertex.
template <class Rule, class PointOf>
std::uint64_t count_pieces(const TriangleMesh& mesh, const Rule& rule, const PointOf& point, std::uint64_t limit,
                           const ExecutionContext* context = nullptr) {
    PieceCounter<Rule> counter(rule, limit, context);
    for (const Triangle& t : mesh.faces) {
        counter.add({point(t[0]), point(t[1]), point(t[2])});
        if (counter.over()) return limit + 1;
    }
    return counter.pieces();
}

/// A mesh on its way, with what the rule knows of each vertex.
template <class Rule>
struct Subdivision {
    std::vector<typename Rule::Point> points;
    std::vector<Triangle> faces;
    std::vector<std::uint32_t> parent;
};

template <class Rule, class PointOf>
Subdivision<Rule> start_subdivision(const TriangleMesh& mesh, const PointOf& point) {
    Subdivision<Rule> start;
    start.points.reserve(mesh.positions.size());
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) start.points.push_back(point(v));
    start.faces = mesh.faces;
    start.parent.resize(mesh.faces.size());
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) start.parent[f] = f;
    return start;
}

/// One round: cuts every face by its marked edges. `midpoints` holds the vertex on each half-edge's edge, or kNone.
template <class Rule>
void cut_marked(Subdivision<Rule>& current, const std::vector<std::uint32_t>& midpoints, std::size_t marked_edges) {
    std::vector<Triangle> faces;
    std::vector<std::uint32_t> parent;
    // Each marked edge of a closed mesh adds one face on either side.
    faces.reserve(current.faces.size() + 2 * marked_edges);
    parent.reserve(faces.capacity());
    const auto& points = current.points;
    for (std::size_t f = 0; f < current.faces.size(); ++f) {
        const Triangle& t = current.faces[f];
        const std::size_t first = 3 * f;
        const std::array<std::uint32_t, 6> ids{t[0], t[1], t[2], midpoints[first], midpoints[first + 1], midpoints[first + 2]};
        const auto shorter = [&](int a, int b, int c, int d) {
            return (points[ids[a]].p - points[ids[c]].p).squaredNorm() <= (points[ids[b]].p - points[ids[d]].p).squaredNorm();
        };
        cut_face({ids[3] != kNone, ids[4] != kNone, ids[5] != kNone}, shorter, [&](int a, int b, int c) {
            faces.push_back({ids[a], ids[b], ids[c]});
            parent.push_back(current.parent[f]);
        });
    }
    current.faces = std::move(faces);
    current.parent = std::move(parent);
}

/// Puts midpoints on the edges the rule wants, in order of the edges' vertices, and cuts the faces. False when there is none.
template <class Rule>
bool subdivide_round(Subdivision<Rule>& current, const Rule& rule) {
    std::vector<std::uint32_t> midpoints(current.faces.size() * 3, kNone);
    std::size_t marked = 0;
    auto& points = current.points;
    EdgeIndex(current.faces, points.size()).for_each_edge([&](const EdgeIndex::Entry* first, const EdgeIndex::Entry* last) {
        if (!rule.wants(points[first->a], points[first->b])) return;
        for (const auto* entry = first; entry != last; ++entry)
            midpoints[entry->half_edge] = static_cast<std::uint32_t>(points.size());
        points.push_back(rule.midpoint(points[first->a], points[first->b]));
        ++marked;
    });
    if (marked > 0) cut_marked(current, midpoints, marked);
    return marked > 0;
}

template <class Rule>
SubdividedMesh finish_subdivision(Subdivision<Rule> current) {
    SubdividedMesh result;
    result.mesh.positions.reserve(current.points.size());
    for (const auto& point : current.points) result.mesh.positions.push_back(point.p);
    result.mesh.faces = std::move(current.faces);
    result.parent = std::move(current.parent);
    return result;
}

/// Rounds until the rule wants no edge cut; `predicted` faces will come out, for the progress of stage "subdivide".
template <class Rule, class PointOf>
Expected<SubdividedMesh> subdivide_by(const TriangleMesh& mesh, const Rule& rule, const PointOf& point, std::uint64_t predicted,
                                      const ExecutionContext& context) {
    Subdivision<Rule> current = start_subdivision<Rule>(mesh, point);
    if (predicted == mesh.face_count()) return finish_subdivision(std::move(current));
    do {
        if (context.cancelled()) return ExecutionContext::cancelled_error();
        const auto faces = static_cast<std::uint32_t>(current.faces.size());
        context.report({"subdivide", static_cast<double>(faces) / static_cast<double>(predicted), faces});
    } while (subdivide_round(current, rule));
    return finish_subdivision(std::move(current));
}

/// The least `length`, within a fifth, whose `count(length)` keeps to `limit`. Comes from the coarse side, where counting is
/// cheap. \pre `count` does not grow with length and `coarsest` fits.
template <class Count>
double fitting_length(double coarsest, std::uint64_t limit, const Count& count) {
    double fits = coarsest;
    double too_small = fits / 2;
    for (; count(too_small) <= limit; too_small /= 2) fits = too_small;
    while (fits > 1.2 * too_small) {
        const double middle = std::sqrt(too_small * fits);
        (count(middle) > limit ? too_small : fits) = middle;
    }
    return fits;
}

}  // namespace vsplit
