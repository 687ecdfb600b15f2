#pragma once

#include <cstdint>
#include <vector>

#include "mesh/half_edges.h"
#include "vsplit/features/face_normals.h"

namespace vsplit {

/// The circle that the faces at both sides of an edge lie on, in the plane across the edge: of a surface that is bent around a
/// line or a curve it is a section, where the edge runs along it.
struct TubeSection {
    HalfEdge edge = 0;           ///< the smaller of its two
    Vec3 centre = Vec3::Zero();  ///< beside the middle of the edge
    Vec3 along = Vec3::Zero();   ///< of length 1
    double length = 0;           ///< of the edge
    double radius = 0;
    double bend = 0;  ///< radians, > 0
    bool convex = false;
};

/// Faces in strips side by side that are bent around one line or curve at one radius.
struct Tube {
    std::vector<TubeSection> sections;  ///< in order of edges
    std::vector<std::uint32_t> faces;   ///< ascending
    std::vector<Vec3> along;            ///< of each face, of length 1, either way
};

/// Tubes of at least three strips, as CAD tessellates cylinders, tori and what goes over from one to the other. Some are no
/// fillets: whole cylinders are tubes as well, and faces can be of two.
/// \param angle degrees: an edge that bends by more is none inside a tube. \pre a closed manifold. O(faces log faces).
[[nodiscard]] std::vector<Tube> find_tubes(const TriangleMesh& mesh, const FaceNormals& normals,
                                           const std::vector<HalfEdge>& twin, double angle);

}  // namespace vsplit
