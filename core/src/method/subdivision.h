#pragma once

#include "method/size_plan.h"
#include "sizing/frozen_boundary.h"
#include "vsplit/subdivide/subdivide.h"

namespace vsplit {

/// A subdivision, subdivided again by `next`.
template <class Next>
[[nodiscard]] Expected<SubdividedMesh> refined(SubdividedMesh fine, Next next) {
    Expected<SubdividedMesh> finer = next(fine.mesh);
    if (finer) {
        for (std::uint32_t& parent : finer->parent) parent = fine.parent[parent];
    }
    return finer;
}

/// subdivide_to_size, with edges of open boundaries split or `frozen`.
[[nodiscard]] inline Expected<SubdividedMesh> to_size(const TriangleMesh& mesh, double size, bool frozen, const FaceLimit& limit,
                                                      const ExecutionContext& context) {
    return frozen ? subdivide_to_size_inside(mesh, size, limit, context) : subdivide_to_size(mesh, size, limit, context);
}

/// subdivide_to_sizes, with edges of open boundaries split or `frozen`. \pre `sizes` was made for `mesh`.
[[nodiscard]] inline Expected<SubdividedMesh> to_sizes(const TriangleMesh& mesh, const SizePlan& sizes, bool frozen,
                                                       const FaceLimit& limit, const ExecutionContext& context) {
    return frozen ? subdivide_to_sizes_inside(mesh, sizes.field, limit, context)
                  : subdivide_to_sizes(mesh, sizes.field, limit, context);
}

}  // namespace vsplit
