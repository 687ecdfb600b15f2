#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/half_edges.h"
#include "repair/changes.h"
#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// A mesh under repair. Every face knows the face of the input it comes from, and has its region where there are any.
struct Draft {
    TriangleMesh mesh;
    std::vector<std::uint32_t> parent;  ///< as in RepairedMesh
    Changes changes;

    explicit Draft(const TriangleMesh& input);

    [[nodiscard]] Vec3 centroid(std::uint32_t face) const;
    [[nodiscard]] const Vec3& at(std::uint32_t vertex) const { return mesh.positions[vertex]; }

    /// Drops the faces that are marked. O(faces).
    void erase_faces(const std::vector<bool>& marked);

    /// Adds faces that are parts of another or lie beside it, and have its region. O(faces added).
    void add_faces(std::span<const Triangle> faces, std::uint32_t beside);

    /// Drops faces with two equal corners. O(faces).
    void drop_collapsed();
};

/// A vertex to put into a side of a face.
struct SideVertex {
    HalfEdge side = 0;
    double at = 0;  ///< 0..1 from the side's origin: order of several on one side
    std::uint32_t vertex = 0;
};

/// Cuts faces so that each vertex lies on the side it is put into. Of several at the same place of a side, order of vertices.
/// \pre no vertex is put into a face twice, nor into a face it is a corner of. O(faces + n log n).
void insert_on_sides(Draft& draft, std::vector<SideVertex> vertices);

}  // namespace vsplit
