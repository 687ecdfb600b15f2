#pragma once

#include "simplify/simplify.h"
#include "vsplit/features/creases.h"
#include "vsplit/method/method_result.h"
#include "vsplit/subdivide/subdivide.h"

namespace vsplit {

/// What both methods hand to the simplifier, defaults filled in.
struct PrepareOptions {
    FeatureOptions features;
    double tolerance = 0;
    std::uint32_t faces_min = 0;
};

/// Normals, creases and quadrics of a subdivided mesh. Normals are those of the source's faces: subdivision does not change the
/// surface, but slivers cut small no longer show where they look. O(faces).
[[nodiscard]] SimplifyInput prepare(const TriangleMesh& source, SubdividedMesh subdivided, const PrepareOptions& options);

/// The resolution of `mrr` nearest to `faces`, and its figures.
[[nodiscard]] MethodResult describe_resolution(MultiresMesh mrr, std::uint32_t faces);

}  // namespace vsplit
