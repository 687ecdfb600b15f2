#include "mesh/boundary_loops.h"

namespace vsplit {

std::vector<std::vector<HalfEdge>> boundary_loops(const TriangleMesh& mesh) {
    const std::vector<HalfEdge> twin = half_edge_twins(mesh);
    std::vector<HalfEdge> leaving(mesh.positions.size(), kNone);  // the boundary half-edge that leaves a vertex: one at most
    for (HalfEdge h = 0; h < twin.size(); ++h) {
        if (twin[h] == kNone) leaving[origin(mesh, h)] = h;
    }
    std::vector<std::vector<HalfEdge>> loops;
    for (HalfEdge first = 0; first < twin.size(); ++first) {
        if (twin[first] != kNone || leaving[origin(mesh, first)] == kNone) continue;
        std::vector<HalfEdge>& loop = loops.emplace_back();
        for (HalfEdge h = first; h != kNone; h = leaving[origin(mesh, next(h))]) {
            loop.push_back(h);
            leaving[origin(mesh, h)] = kNone;
        }
    }
    return loops;
}

}  // namespace vsplit
