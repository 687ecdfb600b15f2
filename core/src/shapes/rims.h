#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "mesh/half_edges.h"
#include "vsplit/base/expected.h"

namespace vsplit {

/// The border that faces leave behind when they go, in the direction in which they run; half-edges are theirs.
using Rim = std::vector<HalfEdge>;

/// The rims of `faces`, in order of their first half-edge.
/// \return UNSUPPORTED, saying at which vertex, where a rim touches itself. \pre `faces` ascend; `twin` is of the closed mesh.
/// O(faces log faces).
[[nodiscard]] Expected<std::vector<Rim>> find_rims(const TriangleMesh& mesh, const std::vector<HalfEdge>& twin,
                                                   const std::vector<std::uint32_t>& faces);

/// A closed polygon of vertices, in the direction in which the faces run that fill it.
using Ring = std::vector<std::uint32_t>;

/// Where the half-edges of a rim, or of an open part of one, begin.
[[nodiscard]] Ring origins(const TriangleMesh& mesh, const Rim& rim);

using HasEdge = std::function<bool(std::uint32_t, std::uint32_t)>;

/// A new face that looks further away than this from those that it comes in the place of folds over: cosine, 84 degrees.
inline constexpr double kFold = 0.1;

/// Triangles, in vertices of the mesh, that fill a ring without new vertices, of least area.
/// \param has_edge whether two vertices are joined already, so that no new edge may join them.
/// \return UNSUPPORTED, saying why: too long, every filling needs an edge that is there, or folds over.
/// O(edges^3), of at most 500.
[[nodiscard]] Expected<std::vector<Triangle>> fill_ring(const TriangleMesh& mesh, const Ring& ring, const HasEdge& has_edge);

}  // namespace vsplit
