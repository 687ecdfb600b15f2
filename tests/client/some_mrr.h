#pragma once

#include <cstdint>

#include "tests/core/meshes.h"
#include "vsplit/mrr/multires_mesh.h"

namespace vsplit::test {

/// A representation made without a method: a tetrahedron, of which one vertex after the other splits in two, and one moves before
/// every third split. Always valid.
inline MultiresMesh some_mrr(std::uint32_t splits) {
    MultiresMesh mrr{tetrahedron(), {}};
    for (std::uint32_t s = 0; s < splits; ++s) {
        const double x = 1.0 + s;
        if (s % 3 == 1) mrr.records.push_back(VertexMove{s % 4, Vec3(x, x, 0.5)});
        mrr.records.push_back(VertexSplit{(s * 7) % (3 * mrr.faces_at(s)), 1, Vec3(x, 0.5, -x), Vec3(-x, 0.25 * x, x)});
    }
    return mrr;
}

}  // namespace vsplit::test
