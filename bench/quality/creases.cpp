#include "quality/creases.h"

#include "mesh/half_edges.h"
#include "vsplit/features/sharp_edges.h"

namespace vsplit::bench {

std::vector<Segment> sharp_segments(const TriangleMesh& mesh, double angle) {
    std::vector<Segment> segments;
    for (const SharpEdge& e : find_sharp_edges(mesh, face_normals(mesh), {.angle = angle})) {
        segments.push_back({mesh.positions[e.a], mesh.positions[e.b]});
    }
    return segments;
}

std::vector<Segment> border_segments(const TriangleMesh& mesh) {
    std::vector<Segment> segments;
    EdgeIndex(mesh).for_each_edge([&](const EdgeIndex::Entry* first, const EdgeIndex::Entry* last) {
        if (last - first != 2) segments.push_back({mesh.positions[first->a()], mesh.positions[first->b()]});
    });
    return segments;
}

}  // namespace vsplit::bench
