#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "spatial/shape_index.h"
#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// Nearest points on a mesh; elements are its faces. Faces without area count as the segment or point they are.
using SurfaceIndex = ShapeIndex<TriangleShape>;

/// Nearest points on a set of edges; elements are the edges.
using CreaseIndex = ShapeIndex<SegmentShape>;

/// An edge between two vertices of a mesh.
using EdgeEnds = std::array<std::uint32_t, 2>;

/// Keeps copies of the positions, not the mesh. \pre every index of a face is below the number of vertices.
[[nodiscard]] SurfaceIndex surface_index(const TriangleMesh& mesh);

/// \pre every end is below the number of positions.
[[nodiscard]] CreaseIndex crease_index(std::span<const Vec3> positions, std::span<const EdgeEnds> edges);

}  // namespace vsplit
