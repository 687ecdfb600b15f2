#include "simplify/local_state.h"

#include "vsplit/quality/stretch.h"

namespace vsplit {

LocalState initial_state(const SimplifyInput& input) {
    LocalState state;
    state.quadrics = input.quadrics;
    state.sizes = VertexSizes(input.sizes, input.usual_size, input.sizes_bind);
    state.border = Border(input.mesh, input.ghosts, input.boundary_corners, input.freeze_boundary);
    state.faces.resize(input.mesh.faces.size());
    for (std::uint32_t f = 0; f < input.mesh.face_count(); ++f) {
        const Triangle& t = input.mesh.faces[f];
        const Vec3& a = input.mesh.positions[t[0]];
        const Vec3& b = input.mesh.positions[t[1]];
        const Vec3& c = input.mesh.positions[t[2]];
        state.faces[f] = {input.normals[f].cast<float>(), stretch(a, b, c),
                          state.sizes.relative(face_size(a, b, c), t[0], t[1], t[2])};
    }
    return state;
}

}  // namespace vsplit
