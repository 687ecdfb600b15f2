#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "vsplit/base/expected.h"
#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// A small shape of a part that an analysis may do without.
struct ShapeFeature {
    enum class Kind {
        kThroughHole,  ///< a round hole open at both ends, with its chamfers and counterbores
        kBlindHole,    ///< a round hole open at one end, with its bottom
        kBoss,         ///< a round pin on a surface, with its top
    };

    std::uint32_t id = 0;  ///< its place in the list of the mesh
    Kind kind{};
    double diameter = 0;                 ///< of the largest cylinder in it, through its vertices; model units
    double depth = 0;                    ///< along the axis, from rim to rim, bottom or top; model units
    Vec3 axis = Vec3::Zero();            ///< of length 1: from the rim inwards (boss: outwards); of a through hole either way
    Vec3 centre = Vec3::Zero();          ///< on the axis, at half the depth
    std::vector<std::uint32_t> faces{};  ///< side faces, with bottom or top; ascending
};

/// UPPER_SNAKE_CASE, e.g. "THROUGH_HOLE".
[[nodiscard]] std::string_view shape_feature_name(ShapeFeature::Kind kind);

struct FeatureSearch {
    double angle = 40;  ///< degrees, > 0, < 180: edges that bend by more part the surface; a hole of fewer than 360 / angle
                        ///< sides falls apart
};

/// Round holes and bosses of a mesh, in order of their first face: cut along its creases, the surface falls into segments; those
/// that are a whole cylinder, with what closes or widens it, are features ([Date05] 6.3.2, ref. 25). docs/features.md says what
/// is recognised and what is not.
/// \return EMPTY_INPUT, OPEN_MESH or NON_MANIFOLD for a mesh that is no closed manifold; INVALID_OPTION (field "angle").
/// Complexity: O(faces log faces). Deterministic.
[[nodiscard]] Expected<std::vector<ShapeFeature>> list_features(const TriangleMesh& mesh, const FeatureSearch& search = {});

}  // namespace vsplit
