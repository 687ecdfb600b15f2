#include "vsplit/quality/self_intersections.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <string>
#include <vector>

namespace vsplit {
namespace {

using Corners = std::array<Vec3, 3>;

struct Face {
    std::uint32_t index = 0;
    Triangle vertices{};
    Corners corners;
    Vec3 min;
    Vec3 max;
};

/// The side of the plane (a, b, c) that d is on: 1, -1, or 0 where rounding could decide. The bound is that of the first stage of
/// orient3d in Shewchuk, Adaptive Precision Floating-Point Arithmetic (1997).
int side(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const Vec3 ad = a - d;
    const Vec3 bd = b - d;
    const Vec3 cd = c - d;
    double determinant = 0;
    double permanent = 0;
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        const double left = bd[i] * cd[j];
        const double right = bd[j] * cd[i];
        const double third = ad[3 - i - j];
        determinant += third * (left - right);
        permanent += std::abs(third) * (std::abs(left) + std::abs(right));
    }
    constexpr double kBound = 8e-16;
    if (std::abs(determinant) <= kBound * permanent) return 0;
    return determinant > 0 ? 1 : -1;
}

bool passes_through(const Vec3& p, const Vec3& q, const Corners& t) {
    if (side(t[0], t[1], t[2], p) * side(t[0], t[1], t[2], q) != -1) return false;
    const int first = side(p, q, t[0], t[1]);
    return first != 0 && side(p, q, t[1], t[2]) == first && side(p, q, t[2], t[0]) == first;
}

bool an_edge_passes_through(const Corners& edges_of, const Corners& other) {
    for (std::size_t i = 0; i < 3; ++i) {
        if (passes_through(edges_of[i], edges_of[(i + 1) % 3], other)) return true;
    }
    return false;
}

bool share_a_vertex(const Triangle& s, const Triangle& t) {
    return std::any_of(s.begin(), s.end(), [&](std::uint32_t v) { return std::find(t.begin(), t.end(), v) != t.end(); });
}

bool intersect(const Face& s, const Face& t) {
    if ((s.min.array() > t.max.array()).any() || (t.min.array() > s.max.array()).any()) return false;
    if (share_a_vertex(s.vertices, t.vertices)) return false;
    return an_edge_passes_through(s.corners, t.corners) || an_edge_passes_through(t.corners, s.corners);
}

std::vector<Face> faces_along(const TriangleMesh& mesh, int axis) {
    std::vector<Face> faces;
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        const Triangle& t = mesh.faces[f];
        const Corners c{mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]};
        faces.push_back({f, t, c, c[0].cwiseMin(c[1]).cwiseMin(c[2]), c[0].cwiseMax(c[1]).cwiseMax(c[2])});
    }
    std::stable_sort(faces.begin(), faces.end(), [axis](const Face& l, const Face& r) { return l.min[axis] < r.min[axis]; });
    return faces;
}

/// How many pairs the sweep looks at: those that overlap along the axis.
std::uint64_t count_pairs(const std::vector<Face>& faces, int axis) {
    std::uint64_t pairs = 0;
    for (std::size_t i = 0; i < faces.size(); ++i) {
        const auto end = std::upper_bound(faces.begin() + static_cast<std::ptrdiff_t>(i), faces.end(), faces[i].max[axis],
                                          [axis](double most, const Face& face) { return most < face.min[axis]; });
        pairs += static_cast<std::uint64_t>(end - faces.begin()) - i - 1;
    }
    return pairs;
}

}  // namespace

Expected<std::vector<FacePair>> find_self_intersections(const TriangleMesh& mesh, const ExecutionContext& context) {
    int axis = 0;
    const BoundingBox box = bounding_box(mesh);
    if (!box.empty()) (box.max - box.min).maxCoeff(&axis);
    const std::vector<Face> faces = faces_along(mesh, axis);
    if (const std::uint64_t pairs = count_pairs(faces, axis); pairs > kMostFacePairs) {
        return Error{Cause::kLimitExceeded,
                     "self-intersections were not looked for: " + std::to_string(pairs) +
                         " pairs of faces overlap along the longest axis; up to " + std::to_string(kMostFacePairs) +
                         " are searched",
                     ""};
    }
    std::vector<std::vector<FacePair>> found(faces.size());  // a place of its own for each face
    std::atomic<bool> stopped = false;
    tbb::parallel_for(std::size_t{0}, faces.size(), [&](std::size_t i) {
        constexpr std::size_t kLookEvery = 64;  // faces, between two looks for a cancel
        if (i % kLookEvery == 0 && context.cancelled()) stopped = true;
        if (stopped) return;
        for (std::size_t j = i + 1; j < faces.size() && faces[j].min[axis] <= faces[i].max[axis]; ++j) {
            if (!intersect(faces[i], faces[j])) continue;
            const auto [first, second] = std::minmax(faces[i].index, faces[j].index);
            found[i].push_back({first, second});
        }
    });
    if (stopped) return ExecutionContext::cancelled_error();
    std::vector<FacePair> pairs;
    for (const std::vector<FacePair>& of_face : found) pairs.insert(pairs.end(), of_face.begin(), of_face.end());
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

}  // namespace vsplit
