#include "simplify/local_state.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <utility>

#include "base/huge_pages.h"
#include "base/release.h"
#include "vsplit/quality/stretch.h"

namespace vsplit {

namespace {

/// All but the quadrics.
LocalState state_without_quadrics(const SimplifyInput& input) {
    LocalState state;
    state.sizes = VertexSizes(input.sizes, input.usual_size, input.sizes_bind);
    state.border = Border(input.mesh, input.ghosts, input.boundary_corners, input.freeze_boundary);
    state.faces = large_vector<FaceState>(input.mesh.faces.size());
    const tbb::blocked_range<std::uint32_t> faces(0, input.mesh.face_count(), 4096);
    tbb::parallel_for(faces, [&](const tbb::blocked_range<std::uint32_t>& range) {
        for (std::uint32_t f = range.begin(); f < range.end(); ++f) {
            const Triangle& t = input.mesh.faces[f];
            const Vec3& a = input.mesh.positions[t[0]];
            const Vec3& b = input.mesh.positions[t[1]];
            const Vec3& c = input.mesh.positions[t[2]];
            state.faces[f] = {input.normals[f], stretch(a, b, c), state.sizes.relative(face_size(a, b, c), t[0], t[1], t[2])};
        }
    });
    return state;
}

}  // namespace

LocalState initial_state(const SimplifyInput& input) {
    LocalState state = state_without_quadrics(input);
    state.quadrics = input.quadrics;
    return state;
}

LocalState take_initial_state(SimplifyInput& input) {
    LocalState state = state_without_quadrics(input);
    state.quadrics = std::move(input.quadrics);
    release(input.mesh);
    release(input.normals);
    release(input.sizes);
    release(input.boundary_corners);
    return state;
}

}  // namespace vsplit
