#include "vsplit/quality/self_intersections.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <string>
#include <utility>
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

using Sides = std::array<int, 3>;

Sides sides_of(const Corners& corners, const Corners& plane) {
    return {side(plane[0], plane[1], plane[2], corners[0]), side(plane[0], plane[1], plane[2], corners[1]),
            side(plane[0], plane[1], plane[2], corners[2])};
}

bool are_on_both(const Sides& s) {
    return *std::min_element(s.begin(), s.end()) < 0 && *std::max_element(s.begin(), s.end()) > 0;
}

/// The corner that has none of the others on its side, of corners that are on both.
std::size_t alone(const Sides& s) {
    std::size_t i = 0;
    while (s[i] == 0 || s[(i + 1) % 3] == s[i] || s[(i + 2) % 3] == s[i]) ++i;
    return i;
}

Corners beginning_at(const Corners& c, std::size_t first) { return {c[first], c[(first + 1) % 3], c[(first + 2) % 3]}; }

/// Whether the insides cross: both triangles cut the other's plane, in parts of the planes' common line that have more than a
/// point in common. Guigue, Devillers: Fast and Robust Triangle-Triangle Overlap Test Using Orientation Predicates (2003), with
/// their "at most" made "less than".
bool cross(const Corners& s, const Corners& t) {
    const Sides of_t = sides_of(t, s);
    if (!are_on_both(of_t)) return false;
    const Sides of_s = sides_of(s, t);
    if (!are_on_both(of_s)) return false;
    constexpr int kAbove = -1;
    Corners p = beginning_at(s, alone(of_s));
    Corners q = beginning_at(t, alone(of_t));
    if (of_s[alone(of_s)] != kAbove) std::swap(q[1], q[2]);
    if (of_t[alone(of_t)] != kAbove) std::swap(p[1], p[2]);
    return side(p[0], p[1], q[0], q[1]) > 0 && side(p[0], p[2], q[2], q[0]) > 0;
}

bool share_a_vertex(const Triangle& s, const Triangle& t) {
    return std::any_of(s.begin(), s.end(), [&](std::uint32_t v) { return std::find(t.begin(), t.end(), v) != t.end(); });
}

bool intersect(const Face& s, const Face& t) {
    if ((s.min.array() > t.max.array()).any() || (t.min.array() > s.max.array()).any()) return false;
    if (share_a_vertex(s.vertices, t.vertices)) return false;
    return cross(s.corners, t.corners);
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
