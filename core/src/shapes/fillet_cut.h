#pragma once

#include <functional>
#include <vector>

#include "shapes/rims.h"
#include "vsplit/features/face_normals.h"
#include "vsplit/shapes/shape_features.h"

namespace vsplit {

/// What goes with a fillet, and what it leaves open.
struct FilletCut {
    /// The fillet's, and those beside the arcs at its ends, as an arc that becomes a straight line changes them; ascending.
    std::vector<std::uint32_t> faces;
    /// At each end the border of the latter from one side of the fillet to the other: a straight line closes it. None where the
    /// fillet is closed.
    std::vector<Rim> ends;
};

/// \return UNSUPPORTED, saying why: an end does not meet one plane. \pre `fillet` has two sides. O(faces of the fillet, log).
[[nodiscard]] Expected<FilletCut> cut_fillet(const TriangleMesh& mesh, const FaceNormals& normals,
                                             const std::vector<HalfEdge>& twin, const ShapeFeature& fillet);

/// A piece of the band between two sides: its border, and triangles in vertices of the mesh.
struct BandPiece {
    Ring border;
    std::vector<Triangle> faces;
};

/// The band of the shortest edges between a fillet's sides: one disk, or two that together go around.
/// \param has_edge whether two vertices are joined already, so that no new edge may join them.
/// \return UNSUPPORTED, saying why: sides with too many vertices, a band that needs an edge that is there, or folds over.
/// O(product of the vertices of both sides).
[[nodiscard]] Expected<std::vector<BandPiece>> band_between_sides(const TriangleMesh& mesh, const FaceNormals& normals,
                                                                  const std::vector<HalfEdge>& twin, const ShapeFeature& fillet,
                                                                  const HasEdge& has_edge);

}  // namespace vsplit
