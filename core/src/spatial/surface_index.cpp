#include "spatial/surface_index.h"

namespace vsplit {

SurfaceIndex surface_index(const TriangleMesh& mesh) {
    std::vector<TriangleShape> shapes;
    shapes.reserve(mesh.faces.size());
    for (const Triangle& t : mesh.faces) shapes.push_back({{mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]}});
    return SurfaceIndex(std::move(shapes));
}

CreaseIndex crease_index(std::span<const Vec3> positions, std::span<const EdgeEnds> edges) {
    std::vector<SegmentShape> shapes;
    shapes.reserve(edges.size());
    for (const EdgeEnds& e : edges) shapes.push_back({{positions[e[0]], positions[e[1]]}});
    return CreaseIndex(std::move(shapes));
}

}  // namespace vsplit
