#pragma once

#include <cstdint>
#include <vector>

#include "vsplit/mesh/triangle_mesh.h"

/// Parts with rounded edges, tessellated as CAD does: closed, manifold, strips as long as they can be, vertices on the true arcs.
namespace vsplit::test {

/// A block [0, 20] x [0, 10] x [0, length] whose edge at (20, 10) is rounded: `strips` strips of faces. radius 0: none.
[[nodiscard]] TriangleMesh rounded_block(double radius, std::uint32_t strips, double length);

/// An L of sides 20 and thickness 5, of this length, its inner corner rounded.
[[nodiscard]] TriangleMesh rounded_angle(double radius, std::uint32_t strips, double length);

/// A plate [0, 30]^2 x [-5, 0] with a boss of radius 6 and height 8 at its middle, the foot rounded. \pre 4 divides `around`.
[[nodiscard]] TriangleMesh boss_with_rounded_foot(double radius, std::uint32_t strips, std::uint32_t around);

/// The same plate with a through hole of radius 6, its upper mouth rounded.
[[nodiscard]] TriangleMesh hole_with_rounded_mouth(double radius, std::uint32_t strips, std::uint32_t around);

/// A box of these sides around the origin whose edges and corners are all round.
[[nodiscard]] TriangleMesh rounded_box(const Vec3& sides, double radius, std::uint32_t strips);

/// A slab of height 6 over a slot's outline, of width 16 and length 46, its upper edge rounded; 2 * `around` faces around in a
/// strip beside the long ones.
[[nodiscard]] TriangleMesh rounded_slab(double radius, std::uint32_t strips, std::uint32_t around);

}  // namespace vsplit::test
