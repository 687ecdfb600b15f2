#include "vsplit/features/creases.h"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include "features/crease_marks.h"
#include "features/crease_noise.h"
#include "features/voted_edges.h"

namespace vsplit {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

Error wrong_edge(std::size_t pair, const std::string& what) {
    return {Cause::kInvalidOption, "marked_edges: pair " + std::to_string(pair) + " " + what, "marked_edges"};
}

std::string named(const Edge& edge) { return "(" + std::to_string(edge.first) + ", " + std::to_string(edge.second) + ")"; }

Status check_marks(const TriangleMesh& mesh, const std::vector<std::uint32_t>& marks) {
    if (marks.size() % 2 != 0) {
        return Error{Cause::kInvalidOption,
                     "marked_edges holds " + std::to_string(marks.size()) +
                         " numbers; accepted are pairs of vertices, two numbers an edge",
                     "marked_edges"};
    }
    std::vector<std::pair<Edge, std::size_t>> wanted;
    for (std::size_t i = 0; i < marks.size(); i += 2) {
        const Edge given{marks[i], marks[i + 1]};
        if (std::max(given.first, given.second) >= mesh.vertex_count()) {
            return wrong_edge(i / 2,
                              "is " + named(given) + "; accepted are vertices below " + std::to_string(mesh.vertex_count()));
        }
        wanted.emplace_back(std::minmax(given.first, given.second), i / 2);
    }
    std::sort(wanted.begin(), wanted.end());
    std::vector<bool> found(wanted.size(), false);
    for (HalfEdge h = 0; h < mesh.faces.size() * 3; ++h) {
        const Edge ends = std::minmax(origin(mesh, h), origin(mesh, next(h)));
        for (auto at = std::lower_bound(wanted.begin(), wanted.end(), std::pair(ends, std::size_t{0}));
             at != wanted.end() && at->first == ends; ++at) {
            found[at->second] = true;
        }
    }
    const auto missing = std::find(found.begin(), found.end(), false);
    if (missing == found.end()) return Done{};
    const auto pair = static_cast<std::size_t>(missing - found.begin());
    return wrong_edge(pair, "is " + named({marks[2 * pair], marks[2 * pair + 1]}) +
                                ", which no face has as a side; accepted are edges of the source mesh");
}

void mark_regions(const std::vector<std::uint32_t>& regions, double weight, CreaseMarks& marks) {
    if (regions.empty()) return;
    for (HalfEdge h = 0; h < marks.half_edge_count(); ++h) {
        const HalfEdge twin = marks.twin(h);
        if (twin != kNone && regions[face_of(h)] != regions[face_of(twin)]) marks.mark(h, weight);
    }
}

double distance_to_line(const Vec3& point, const Vec3& a, const Vec3& b) {
    const Vec3 way = b - a;
    const double square = way.squaredNorm();
    const Vec3 offset = point - a;
    return square > 0 ? (offset - offset.dot(way) / square * way).squaredNorm() : offset.squaredNorm();
}

/// The side of a source face that a side of one of its pieces lies on, told by the faces beyond; where two sides border the
/// same face, the nearer.
HalfEdge side_of_parent(const TriangleMesh& source, const CreaseMarks& marks, std::uint32_t parent, std::uint32_t beyond,
                        const Vec3& middle) {
    HalfEdge best = kNone;
    double nearest = std::numeric_limits<double>::infinity();
    for (HalfEdge h = 3 * parent; h < 3 * parent + 3; ++h) {
        const HalfEdge twin = marks.twin(h);
        if ((twin == kNone ? kNone : face_of(twin)) != beyond) continue;
        const double distance =
            distance_to_line(middle, source.positions[origin(source, h)], source.positions[origin(source, next(h))]);
        if (distance >= nearest) continue;
        nearest = distance;
        best = h;
    }
    return best;
}

}  // namespace

Status check_features(const TriangleMesh& mesh, const std::vector<std::uint32_t>& marked_edges,
                      const std::vector<std::uint32_t>& regions) {
    if (!regions.empty() && regions.size() != mesh.faces.size()) {
        return Error{Cause::kInvalidOption,
                     "regions holds " + std::to_string(regions.size()) + " ids; accepted is one for each of the " +
                         std::to_string(mesh.face_count()) + " faces of the source, or none",
                     "regions"};
    }
    return check_marks(mesh, marked_edges);
}

std::vector<SharpEdge> find_creases(const TriangleMesh& mesh, const FaceNormals& normals, const FeatureOptions& options) {
    CreaseMarks marks(mesh);
    if (options.detection == FeatureDetection::kDihedral) {
        marks.mark(without_noise(find_sharp_edges(mesh, normals, {options.angle, options.weight}), mesh, options.least_branch));
    } else {
        marks.mark(voted_edges(mesh, normals, options.angle, options.weight));
        for (HalfEdge h = 0; h < marks.half_edge_count(); ++h) {
            if (marks.twin(h) == kNone) marks.mark(h, options.weight);
        }
    }
    std::vector<SharpEdge> given;
    for (std::size_t i = 0; i + 1 < options.marked_edges.size(); i += 2) {
        given.push_back({options.marked_edges[i], options.marked_edges[i + 1], options.weight});
    }
    marks.mark(given);
    mark_regions(options.regions, options.weight, marks);
    return marks.edges();
}

std::vector<SharpEdge> creases_on(const SubdividedMesh& fine, const TriangleMesh& source, const std::vector<SharpEdge>& creases) {
    CreaseMarks coarse(source);
    coarse.mark(creases);
    CreaseMarks marks(fine.mesh);
    for (HalfEdge h = 0; h < marks.half_edge_count(); ++h) {
        const HalfEdge twin = marks.twin(h);
        const std::uint32_t parent = fine.parent[face_of(h)];
        const std::uint32_t beyond = twin == kNone ? kNone : fine.parent[face_of(twin)];
        if (parent == beyond) continue;
        const Vec3 middle = (fine.mesh.positions[origin(fine.mesh, h)] + fine.mesh.positions[origin(fine.mesh, next(h))]) / 2;
        const HalfEdge side = side_of_parent(source, coarse, parent, beyond, middle);
        if (side != kNone && coarse.marked(side)) marks.mark(h, coarse.weight(side));
    }
    return marks.edges();
}

}  // namespace vsplit
