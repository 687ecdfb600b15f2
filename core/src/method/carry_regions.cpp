#include "method/carry_regions.h"

#include <tbb/parallel_for.h>

#include <cassert>

#include "mesh/cap_boundaries.h"
#include "spatial/surface_index.h"
#include "vsplit/mrr/progressive_mesh.h"

namespace vsplit {

void carry_regions(const TriangleMesh& source, const std::vector<std::uint32_t>& regions, MultiresMesh& mrr) {
    if (regions.empty()) return;
    Expected<ProgressiveMesh> finest = ProgressiveMesh::from_base(mrr.base, mrr.ghosts);
    assert(finest.has_value());
    [[maybe_unused]] const Status refined = finest->refine(mrr.records);
    assert(refined.has_value());
    const TriangleMesh& mesh = finest->mesh();
    const SurfaceIndex index = surface_index(source);
    mrr.regions.assign(mesh.faces.size(), 0);
    tbb::parallel_for(std::size_t{0}, mesh.faces.size(), [&](std::size_t f) {
        const Triangle& t = mesh.faces[f];
        if (touches_ghost(t, mrr.ghosts)) return;
        const Vec3 middle = (mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]) / 3;
        mrr.regions[f] = regions[index.closest(middle).element];
    });
    mrr.sets = source.sets;
}

}  // namespace vsplit
