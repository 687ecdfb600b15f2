#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "simplify/half_edge_mesh.h"
#include "simplify/simplify.h"
#include "vsplit/quality/stretch.h"

namespace vsplit {

/// Shape of a live face and where it looks; the normal of a sliver may be borrowed.
struct FaceState {
    Vec3 normal = Vec3::Zero();
    double stretch = 0;
    double size = 0;
};

/// Sums over the faces around a vertex, so that what an edge has before its collapse is known in O(1).
struct VertexState {
    double stretch_sum = 0;
    double stretch_min = 0;
    double weight_sum = 0;   ///< of the policy's face_weight
};

/// Everything the simplifier knows of the mesh beside its connectivity.
struct LocalState {
    std::vector<FaceState> faces;
    std::vector<VertexState> vertices;
    std::vector<Quadric> quadrics;
};

/// Sums up the faces around v anew. O(valence).
template <class Policy>
void update_vertex(LocalState& state, const HalfEdgeMesh& mesh, const Policy& policy, std::uint32_t v) {
    VertexState sums{0, std::numeric_limits<double>::infinity(), 0};
    mesh.for_each_outgoing(v, [&](HalfEdge h) {
        const FaceState& face = state.faces[face_of(h)];
        sums.stretch_sum += face.stretch;
        sums.stretch_min = std::min(sums.stretch_min, face.stretch);
        sums.weight_sum += policy.face_weight(face.size);
    });
    state.vertices[v] = sums;
}

/// The state of the mesh that `mesh` was made from. O(faces).
template <class Policy>
[[nodiscard]] LocalState initial_state(const SimplifyInput& input, const HalfEdgeMesh& mesh, const Policy& policy) {
    LocalState state;
    state.quadrics = input.quadrics;
    state.faces.resize(input.mesh.faces.size());
    for (std::uint32_t f = 0; f < input.mesh.face_count(); ++f) {
        const Triangle& t = input.mesh.faces[f];
        const Vec3& a = input.mesh.positions[t[0]];
        const Vec3& b = input.mesh.positions[t[1]];
        const Vec3& c = input.mesh.positions[t[2]];
        state.faces[f] = {input.normals[f], stretch(a, b, c), face_size(a, b, c)};
    }
    state.vertices.resize(mesh.vertex_count());
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) update_vertex(state, mesh, policy, v);
    return state;
}

}  // namespace vsplit
