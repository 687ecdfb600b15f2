#include "vsplit/subdivide/subdivide.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <string>

#include "mesh/half_edges.h"

namespace vsplit {
namespace {

constexpr std::uint32_t kMaxTimes = 12;

struct Corners {
    std::array<Vec3, 3> p;
};

bool longer(const Vec3& a, const Vec3& b, double max_edge) { return (a - b).squaredNorm() > max_edge * max_edge; }

Vec3 midpoint(const Vec3& a, const Vec3& b) { return (a + b) * 0.5; }

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

std::array<bool, 3> mark(const Corners& face, double max_edge) {
    return {longer(face.p[0], face.p[1], max_edge), longer(face.p[1], face.p[2], max_edge),
            longer(face.p[2], face.p[0], max_edge)};
}

/// Counts the faces each face ends as. Depth-first with an explicit stack: its depth is the logarithm of the edge over max_edge.
class PieceCounter {
public:
    PieceCounter(double max_edge, std::uint64_t limit) : max_edge_(max_edge), limit_(limit) {}

    /// More than the limit in all.
    [[nodiscard]] bool over() const { return pieces_ > limit_; }
    [[nodiscard]] std::uint64_t pieces() const { return pieces_; }

    void add(const Corners& face) {
        cut(face);
        while (!open_.empty() && pieces_ + open_.size() <= limit_) {
            const Corners f = open_.back();
            open_.pop_back();
            cut(f);
        }
        pieces_ += open_.size();
        open_.clear();
    }

private:
    void cut(const Corners& f) {
        const std::array<bool, 3> marked = mark(f, max_edge_);
        if (!marked[0] && !marked[1] && !marked[2]) {
            ++pieces_;
            return;
        }
        const std::array<Vec3, 6> points{
            f.p[0], f.p[1], f.p[2], midpoint(f.p[0], f.p[1]), midpoint(f.p[1], f.p[2]), midpoint(f.p[2], f.p[0])};
        const auto shorter = [&](int a, int b, int c, int d) {
            return (points[a] - points[c]).squaredNorm() <= (points[b] - points[d]).squaredNorm();
        };
        cut_face(marked, shorter, [&](int a, int b, int c) { open_.push_back({{points[a], points[b], points[c]}}); });
    }

    double max_edge_;
    std::uint64_t limit_;
    std::uint64_t pieces_ = 0;
    std::vector<Corners> open_;
};

/// One round: cuts every face by its marked edges. `midpoints` holds the vertex on each half-edge's edge, or kNone.
SubdividedMesh cut_marked(const SubdividedMesh& from, TriangleMesh&& with_midpoints, const std::vector<std::uint32_t>& midpoints,
                          std::size_t marked_edges) {
    SubdividedMesh to;
    to.mesh.positions = std::move(with_midpoints.positions);
    const std::vector<Vec3>& points = to.mesh.positions;
    // Each marked edge of a closed mesh adds one face on either side.
    to.mesh.faces.reserve(from.mesh.faces.size() + 2 * marked_edges);
    to.parent.reserve(to.mesh.faces.capacity());
    for (std::uint32_t f = 0; f < from.mesh.face_count(); ++f) {
        const Triangle& t = from.mesh.faces[f];
        const HalfEdge first = 3 * f;
        const std::array<std::uint32_t, 6> ids{t[0], t[1], t[2], midpoints[first], midpoints[first + 1], midpoints[first + 2]};
        const auto shorter = [&](int a, int b, int c, int d) {
            return (points[ids[a]] - points[ids[c]]).squaredNorm() <= (points[ids[b]] - points[ids[d]]).squaredNorm();
        };
        cut_face({ids[3] != kNone, ids[4] != kNone, ids[5] != kNone}, shorter, [&](int a, int b, int c) {
            to.mesh.faces.push_back({ids[a], ids[b], ids[c]});
            to.parent.push_back(from.parent[f]);
        });
    }
    return to;
}

/// Puts midpoints on the edges `wanted(a, b)` says, in order of the edges' vertices, and cuts the faces. False when there is
/// none.
template <class Wanted>
bool subdivide_round(SubdividedMesh& current, Wanted wanted) {
    std::vector<std::uint32_t> midpoints(current.mesh.faces.size() * 3, kNone);
    std::size_t marked = 0;
    const EdgeIndex edges(current.mesh);
    TriangleMesh points;
    points.positions = std::move(current.mesh.positions);
    edges.for_each_edge([&](const EdgeIndex::Entry* first, const EdgeIndex::Entry* last) {
        const Vec3 a = points.positions[first->a()];
        const Vec3 b = points.positions[first->b()];
        if (!wanted(a, b)) return;
        for (const auto* entry = first; entry != last; ++entry) midpoints[entry->half_edge] = points.vertex_count();
        points.positions.push_back(midpoint(a, b));
        ++marked;
    });
    if (marked == 0) {
        current.mesh.positions = std::move(points.positions);
        return false;
    }
    current = cut_marked(current, std::move(points), midpoints, marked);
    return true;
}

SubdividedMesh unchanged(const TriangleMesh& mesh) {
    SubdividedMesh result{mesh, std::vector<std::uint32_t>(mesh.faces.size())};
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) result.parent[f] = f;
    return result;
}

std::string number(double value) {
    std::array<char, 32> text{};
    const int length = std::snprintf(text.data(), text.size(), "%.6g", value);
    return {text.data(), static_cast<std::size_t>(length)};
}

/// The smallest max_edge, within a fifth, that keeps to the limit. Comes from the coarse side, where counting is cheap.
double fitting_max_edge(const TriangleMesh& mesh, std::uint64_t limit) {
    double fits = bounding_box(mesh).diagonal();
    double too_small = fits / 2;
    for (; predict_subdivision(mesh, too_small, limit) <= limit; too_small /= 2) fits = too_small;
    while (fits > 1.2 * too_small) {
        const double middle = std::sqrt(too_small * fits);
        (predict_subdivision(mesh, middle, limit) > limit ? too_small : fits) = middle;
    }
    return fits;
}

}  // namespace

std::uint64_t predict_subdivision(const TriangleMesh& mesh, double max_edge, std::uint64_t limit) {
    // No piece has more area than the equilateral triangle of that edge, so far too many need not be counted.
    constexpr double kEquilateralArea = 0.4330127018922193;
    if (surface_area(mesh) > 1.01 * kEquilateralArea * max_edge * max_edge * static_cast<double>(limit)) return limit + 1;
    PieceCounter counter(max_edge, limit);
    for (const Triangle& t : mesh.faces) {
        counter.add({{mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]}});
        if (counter.over()) return limit + 1;
    }
    return counter.pieces();
}

Expected<SubdividedMesh> subdivide_to_size(const TriangleMesh& mesh, double max_edge, std::uint32_t face_limit,
                                           const ExecutionContext& context) {
    if (!(max_edge > 0) || !std::isfinite(max_edge)) {
        return Error{Cause::kInvalidOption, "the subdivision size is " + number(max_edge) + "; a positive length is needed",
                     "subdivision_size"};
    }
    if (mesh.face_count() > face_limit) {
        return Error{Cause::kLimitExceeded,
                     "the mesh has " + std::to_string(mesh.face_count()) + " faces; the limit is " + std::to_string(face_limit),
                     "subdivision_size"};
    }
    const std::uint64_t predicted = predict_subdivision(mesh, max_edge, face_limit);
    if (predicted > face_limit) {
        return Error{Cause::kLimitExceeded,
                     "subdividing to edges of " + number(max_edge) + " makes more than " + std::to_string(face_limit) +
                         " faces, the limit; a subdivision size of " + number(fitting_max_edge(mesh, face_limit)) + " fits",
                     "subdivision_size"};
    }
    SubdividedMesh current = unchanged(mesh);
    if (predicted == mesh.face_count()) return current;
    const auto wanted = [&](const Vec3& a, const Vec3& b) { return longer(a, b, max_edge); };
    do {
        if (context.cancelled()) return ExecutionContext::cancelled_error();
        context.report({"subdivide", static_cast<double>(current.mesh.face_count()) / static_cast<double>(predicted),
                        current.mesh.face_count()});
    } while (subdivide_round(current, wanted));
    return current;
}

Expected<SubdividedMesh> subdivide_one_to_four(const TriangleMesh& mesh, std::uint32_t times, std::uint32_t face_limit,
                                               const ExecutionContext& context) {
    if (times > kMaxTimes) {
        return Error{Cause::kInvalidOption,
                     std::to_string(times) + " subdivisions; 0 to " + std::to_string(kMaxTimes) + " are possible",
                     "subdivisions"};
    }
    std::uint32_t fitting = 0;
    while (fitting < times && (std::uint64_t{mesh.face_count()} << (2 * (fitting + 1))) <= face_limit) ++fitting;
    if (fitting < times || mesh.face_count() > face_limit) {
        return Error{Cause::kLimitExceeded,
                     std::to_string(times) + " one-to-four subdivisions of " + std::to_string(mesh.face_count()) +
                         " faces make more than " + std::to_string(face_limit) + ", the limit; " + std::to_string(fitting) +
                         " fit",
                     "subdivisions"};
    }
    SubdividedMesh current = unchanged(mesh);
    for (std::uint32_t round = 0; round < times; ++round) {
        if (context.cancelled()) return ExecutionContext::cancelled_error();
        context.report({"subdivide", static_cast<double>(round) / times, current.mesh.face_count()});
        subdivide_round(current, [](const Vec3&, const Vec3&) { return true; });
    }
    return current;
}

}  // namespace vsplit
