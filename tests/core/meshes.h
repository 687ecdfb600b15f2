#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "vsplit/mesh/triangle_mesh.h"

/// Meshes that tests are made of. All are closed, manifold, seen counter-clockwise from outside, and the same on every machine.
namespace vsplit::test {

/// 4 faces, genus 0: the smallest closed mesh.
[[nodiscard]] TriangleMesh tetrahedron();

/// The unit cube [0, 1]^3, 12 faces.
[[nodiscard]] TriangleMesh cube();

/// 20 * 4^subdivisions faces on the unit sphere.
[[nodiscard]] TriangleMesh icosphere(unsigned subdivisions);

/// 2 * around * across faces, radii 1 and 0.4, genus 1. \pre both at least 3.
[[nodiscard]] TriangleMesh torus(std::uint32_t around, std::uint32_t across);

/// A plate of unit cubes with `holes` square holes in a row: genus `holes`, sharp edges everywhere.
[[nodiscard]] TriangleMesh plate_with_holes(std::uint32_t holes);

/// The twelve bars of a cube: genus 5.
[[nodiscard]] TriangleMesh cube_frame();

/// A cylinder as CAD tessellates it: radius 1, the whole side in faces as long as the cylinder, caps cut into fans from one
/// corner. 4 * segments - 4 faces, nearly all slivers, valence up to segments + 1. \pre segments at least 3, length > 0.
[[nodiscard]] TriangleMesh sliver_cylinder(std::uint32_t segments, double length);

/// An icosphere with waves and noise of up to `noise` of the radius, as a scanner would see it.
[[nodiscard]] TriangleMesh bumpy_sphere(unsigned subdivisions, double noise, std::uint64_t seed);

/// The unit cube with `cells` * `cells` squares a side and noise of up to `noise` of their side along each axis.
[[nodiscard]] TriangleMesh noisy_cube(std::uint32_t cells, double noise, std::uint64_t seed);

/// The same surface with vertices and faces in another order and the corners of each face turned.
[[nodiscard]] TriangleMesh shuffled(const TriangleMesh& mesh, std::uint64_t seed);

/// Both meshes in one, `right` moved by `offset`: two components when they do not touch.
[[nodiscard]] TriangleMesh joined(const TriangleMesh& left, const TriangleMesh& right, const Vec3& offset);

/// The mesh without the faces at these vertices: an open boundary around each. \pre no two of them have a face in common or
/// faces that touch.
[[nodiscard]] TriangleMesh punctured(const TriangleMesh& mesh, const std::vector<std::uint32_t>& at);

/// A flat square of 2 * cells * cells faces, one boundary.
[[nodiscard]] TriangleMesh square(std::uint32_t cells);

/// The same with holes of one cell, `holes` of them along its middle: holes + 1 boundaries. \pre 2 * holes < cells.
[[nodiscard]] TriangleMesh holed_square(std::uint32_t cells, std::uint32_t holes);

/// The side of a cylinder of radius 1 and height 2, two boundaries. 2 * around * along faces.
[[nodiscard]] TriangleMesh open_cylinder(std::uint32_t around, std::uint32_t along);

/// The upper half of the unit sphere, its boundary a polygon of `around` corners. (2 * along - 1) * around faces.
[[nodiscard]] TriangleMesh hemisphere(std::uint32_t around, std::uint32_t along);

/// A mesh and what a test calls it.
struct NamedMesh {
    std::string name;
    TriangleMesh mesh;
};

/// One of each kind above, small (at most a few thousand faces).
[[nodiscard]] std::vector<NamedMesh> small_meshes();

/// A file of this repository's tests/data.
[[nodiscard]] std::filesystem::path data_file(const std::string& name);

/// The closed manifold meshes among them: CAD parts, two bodies combined, a scan-like surface.
[[nodiscard]] std::vector<std::filesystem::path> own_closed_meshes();

/// Closed manifold meshes of the real world: CAD, scans, FE surfaces. Empty where that collection is not on this machine (it is
/// no part of the repository).
/// With needles: also one whose facets are millions of times as long as wide, on which the methods take minutes.
[[nodiscard]] std::vector<std::filesystem::path> shared_closed_meshes(bool with_needles = true);

/// The stem of a path, usable as a name of a parameterised test.
[[nodiscard]] std::string test_name(const std::filesystem::path& path);

}  // namespace vsplit::test
