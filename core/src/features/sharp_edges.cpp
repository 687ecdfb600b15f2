#include "vsplit/features/sharp_edges.h"

#include <cmath>
#include <numbers>

#include "mesh/half_edges.h"

namespace vsplit {

std::vector<SharpEdge> find_sharp_edges(const TriangleMesh& mesh, const FaceNormals& normals, const SharpEdgeOptions& options) {
    const double threshold = std::cos(options.angle * std::numbers::pi / 180);
    const std::vector<HalfEdge> twins = half_edge_twins(mesh);
    std::vector<SharpEdge> edges;
    for (HalfEdge h = 0; h < twins.size(); ++h) {
        if (twins[h] == kNone) edges.push_back({origin(mesh, h), origin(mesh, next(h)), options.weight});
        if (twins[h] == kNone || twins[h] < h) continue;
        const double cosine = normals.normals[face_of(h)].dot(normals.normals[face_of(twins[h])]);
        if (cosine < threshold) edges.push_back({origin(mesh, h), origin(mesh, next(h)), options.weight * (1 - cosine)});
    }
    return edges;
}

}  // namespace vsplit
