#include "quality/creases.h"

#include <cmath>
#include <numbers>

#include "mesh/half_edges.h"
#include "vsplit/features/face_normals.h"

namespace vsplit::bench {

std::vector<Segment> sharp_segments(const TriangleMesh& mesh, double angle) {
    // Not find_sharp_edges: which edges the method takes for creases is its business, the bench measures angles.
    const double threshold = std::cos(angle * std::numbers::pi / 180);
    const std::vector<Vec3> normals = face_normals(mesh).normals;
    std::vector<Segment> segments;
    EdgeIndex(mesh).for_each_edge([&](const EdgeIndex::Entry* first, const EdgeIndex::Entry* last) {
        if (last - first != 2) return;
        const double cosine = normals[face_of(first[0].half_edge)].dot(normals[face_of(first[1].half_edge)]);
        if (cosine < threshold) segments.push_back({mesh.positions[first->a], mesh.positions[first->b]});
    });
    return segments;
}

std::vector<Segment> border_segments(const TriangleMesh& mesh) {
    std::vector<Segment> segments;
    EdgeIndex(mesh).for_each_edge([&](const EdgeIndex::Entry* first, const EdgeIndex::Entry* last) {
        if (last - first != 2) segments.push_back({mesh.positions[first->a], mesh.positions[first->b]});
    });
    return segments;
}

}  // namespace vsplit::bench
