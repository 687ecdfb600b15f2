#pragma once

#include <cstdint>
#include <vector>

#include "vsplit/features/face_normals.h"
#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

struct NormalVotingOptions {
    double angle = 40;    ///< degrees, 0..180: what counts as a crease, as with the dihedral test
    double radius = 2.5;  ///< > 0: reach of a neighbourhood along edges, in mean edges of the mesh. More stands more noise, but
                          ///< features narrower than this are lost
};

/// What a vertex lies on, told from the normals around it.
enum class VertexKind : std::uint8_t { kSurface, kCrease, kCorner };

/// What a neighbourhood makes of its normals.
struct VotedNormals {
    std::vector<Vec3> normals;         ///< one a face, unit: what the clearest neighbourhood that holds the face voted for
    std::vector<VertexKind> vertices;  ///< one a vertex
};

/// Normal voting after Page, Sun, Koschan, Paik, Abidi, "Normal vector voting: crease detection and curvature estimation on
/// large, noisy meshes", Graphical Models (2002), [Date05] ref. 22: the faces within `radius` of a vertex vote for its normal
/// with a weight of area * exp(-g / sigma), g their distance along edges; the eigenvalues of the summed tensor, l1 >= l2 >= l3,
/// say how much of a surface (l1 - l2), a crease (l2 - l3) or a corner (l3) there is. Each face then takes the normal of the
/// neighbourhood, among those that hold it, that is most of a surface and least against the face's own normal. So voted normals
/// are smooth on either side of a crease and jump across it, from one face to the next: creases come out as lines, not bands.
///
/// \pre `mesh` is manifold; `normals` belong to it. O(faces * neighbourhood); parallel, the same for any number of threads.
[[nodiscard]] VotedNormals vote_normals(const TriangleMesh& mesh, const FaceNormals& normals, const NormalVotingOptions& options);

}  // namespace vsplit
