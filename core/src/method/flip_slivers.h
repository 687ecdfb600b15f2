#pragma once

#include <memory>

#include "method/cut_needles.h"
#include "method/prepare.h"
#include "vsplit/base/execution_context.h"
#include "vsplit/features/face_normals.h"

namespace vsplit {

/// `mesh` with edges flipped until those of flat places are Delaunay, but creases; null where none is to be flipped. Slivers that
/// fill a flat place cut small give ever more slivers: here they go before anything is cut. Vertices stay, and
/// the surface moves by `gap` at most.
/// \pre `mesh` is manifold. O(faces) for most, the square of the faces of a flat place at worst.
[[nodiscard]] std::shared_ptr<const CreasedMesh> flip_slivers(const TriangleMesh& mesh, const FeatureOptions& features,
                                                              double gap, const ExecutionContext& context);

/// The creases of what a method subdivides: `mesh`, or what replaces it.
template <class Options>
[[nodiscard]] std::vector<SharpEdge> creases_of(const TriangleMesh& mesh, const std::shared_ptr<const CreasedMesh>& replaced,
                                                const Options& options) {
    return replaced ? replaced->creases : find_creases(mesh, face_normals(mesh), feature_options(options));
}

/// `mesh` without the slivers that would be in the way of a subdivision to `size`, null where there are none: flips with a gap
/// that is next to nothing against the tolerance, and where needles are left that are none of a plane's, cuts. `options` are as
/// used.
template <class Options>
[[nodiscard]] std::shared_ptr<const CreasedMesh> without_slivers(const TriangleMesh& mesh, const Options& options, double size,
                                                                 const ExecutionContext& context) {
    constexpr double kGapShare = 1e-3;
    constexpr double kNeedleGapShare = 0.25;
    const double tolerance = *options.tolerance;
    std::shared_ptr<const CreasedMesh> flipped = flip_slivers(mesh, feature_options(options), kGapShare * tolerance, context);
    if (slenderness(flipped ? flipped->mesh : mesh) <= kNeedles) return flipped;
    const CreasedMesh uncut = flipped ? *flipped : CreasedMesh{mesh, creases_of(mesh, flipped, options), 0};
    return std::make_shared<const CreasedMesh>(cut_needles(uncut, size, kNeedleGapShare * tolerance, context));
}

}  // namespace vsplit
