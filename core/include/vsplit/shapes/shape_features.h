#pragma once

#include <array>
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
        kFillet,       ///< a rounded edge, inner or outer: strips of faces that turn from one surface to another at one radius
    };

    std::uint32_t id = 0;  ///< its place in the list of the mesh
    Kind kind{};
    double diameter = 0;       ///< of the largest cylinder in it, of a fillet twice its radius; by its vertices; model units
    double depth = 0;          ///< along the axis, from rim to rim, bottom or top; of a fillet its length; model units
    Vec3 axis = Vec3::Zero();  ///< of length 1: from the rim inwards (boss: outwards); of a through hole either way; of a fillet
                               ///< where it runs, or what it runs around, either way
    Vec3 centre = Vec3::Zero();          ///< on the axis, at half the depth; of a fillet the mean of the centres of its arcs
    std::vector<std::uint32_t> faces{};  ///< side faces, with bottom or top; ascending
    /// Of a fillet: the vertices on its two borders with what it joins, side by side, the first in the order in which its faces
    /// run; where it is closed the last vertex is the first. Of others empty.
    std::array<std::vector<std::uint32_t>, 2> sides{};
};

/// UPPER_SNAKE_CASE, e.g. "THROUGH_HOLE".
[[nodiscard]] std::string_view shape_feature_name(ShapeFeature::Kind kind);

struct FeatureSearch {
    double angle = 40;  ///< degrees, > 0, < 180: edges that bend by more part the surface; a hole of fewer than 360 / angle
                        ///< sides falls apart
};

/// Round holes, bosses and fillets of a mesh, in order of their first face: cut along its creases, the surface falls into
/// segments; those that are a whole cylinder, with what closes or widens it, are features ([Date05] 6.3.2, ref. 25); so are
/// strips of faces bent at one radius that run smoothly into what they join. docs/features.md says what is recognised and what is
/// not. \return EMPTY_INPUT, OPEN_MESH or NON_MANIFOLD for a mesh that is no closed manifold; INVALID_OPTION (field "angle").
/// Complexity: O(faces log faces). Deterministic.
[[nodiscard]] Expected<std::vector<ShapeFeature>> list_features(const TriangleMesh& mesh, const FeatureSearch& search = {});

}  // namespace vsplit
