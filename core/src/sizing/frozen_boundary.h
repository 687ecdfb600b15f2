#pragma once

#include <cstdint>

#include "vsplit/base/execution_context.h"
#include "vsplit/base/expected.h"
#include "vsplit/sizing/size_field.h"
#include "vsplit/subdivide/subdivide.h"

namespace vsplit {

/// As subdivide_to_size, but edges of an open boundary are never split. An unsplit edge of length L over `max_edge` has no good
/// face of small edges at it, so edges near it may be longer: max(max_edge, L - 0.5 * distance along edges).
///
/// Stage "subdivide". \pre `mesh` is manifold. \return as subdivide_to_size. O(result + source faces * log).
[[nodiscard]] Expected<SubdividedMesh> subdivide_to_size_inside(const TriangleMesh& mesh, double max_edge, const FaceLimit& limit,
                                                                const ExecutionContext& context);

/// As subdivide_to_sizes, but edges of an open boundary are never split, and edges near one that is longer than the field allows
/// may be longer as above.
///
/// Stage "subdivide". \pre `field` was made for `mesh`. \return as subdivide_to_sizes.
[[nodiscard]] Expected<SubdividedMesh> subdivide_to_sizes_inside(const TriangleMesh& mesh, const SizeField& field,
                                                                 const FaceLimit& limit, const ExecutionContext& context);

/// As subdivide_one_to_four, but edges of an open boundary are never split, nor those near them that are short for them already.
///
/// Stage "subdivide". \pre `mesh` is manifold. \return as subdivide_one_to_four.
[[nodiscard]] Expected<SubdividedMesh> subdivide_one_to_four_inside(const TriangleMesh& mesh, std::uint32_t times,
                                                                    const FaceLimit& limit, const ExecutionContext& context);

}  // namespace vsplit
