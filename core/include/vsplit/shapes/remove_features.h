#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "vsplit/base/execution_context.h"
#include "vsplit/shapes/shape_features.h"

namespace vsplit {

/// Which features go: those with these ids, and all under the diameter. One of the two must be given.
struct FeatureRemoval {
    FeatureSearch search{};                   ///< as the list was made that the ids are from
    std::vector<std::uint32_t> ids{};         ///< of `list_features` of the same mesh
    std::optional<double> max_diameter{};     ///< length, model units, > 0: all of this diameter, to 0.01 %, and less
    std::vector<ShapeFeature::Kind> kinds{};  ///< with `max_diameter`: of these kinds alone; empty: of all
};

/// A feature that stayed, and why.
struct KeptFeature {
    std::uint32_t id = 0;
    std::string reason;  ///< one sentence
};

/// A mesh without some of its features.
struct FeaturelessMesh {
    /// First the faces that stayed, in their order, every corner where it was, bit for bit; then, from `first_new_face`, those
    /// that fill the rims. Vertices that no face uses any more are gone. New faces have the region of a face beside their rim.
    TriangleMesh mesh;
    /// Of each face: the face of the input it is; of a new one a face beside its rim, at a fillet's end one that it replaces.
    std::vector<std::uint32_t> parent;
    std::uint32_t first_new_face = 0;
    double size = 0;  ///< sigma_SZ: the mean size of the input's faces, which the new ones were aimed at; model units
    std::vector<std::uint32_t> removed{};  ///< ids, ascending
    std::vector<KeptFeature> kept{};       ///< asked for and not removed, by id
};

/// Removes features as [Date05] 6.3.2 does: their faces go, their rims are triangulated without new vertices, and the new faces,
/// and only they, are improved: sigma_SZ is the mean size of the mesh's faces, or less where a rim's edges are much shorter, and
/// no face is larger but where an edge of the rim is. In the place of a fillet comes a band between its sides, a chamfer; faces
/// beside the arcs at its ends, which must lie in a plane, are made anew. A feature whose rim cannot be filled without folding
/// stays, and is in `kept`.
/// Stage: "remove", by features.
/// \return what `list_features` returns; INVALID_OPTION (field "ids", "max_diameter" or "kinds"); CANCELLED.
/// Complexity: O(faces log faces), and cubic in the edges of a rim (of at most 500). Deterministic.
[[nodiscard]] Expected<FeaturelessMesh> remove_features(const TriangleMesh& mesh, const FeatureRemoval& removal,
                                                        const ExecutionContext& context);

}  // namespace vsplit
