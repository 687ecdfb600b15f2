#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "vsplit/base/expected.h"
#include "vsplit/mrr/multires_mesh.h"

namespace vsplit {

/// A mesh that moves between the levels of an MRR by applying and undoing vertex splits. The server and every client build
/// their meshes through this class, so a level is the same everywhere, bit for bit.
///
///     auto mesh = ProgressiveMesh::from_base(mrr.base);
///     mesh->refine(mrr.splits);      // to the finest level
///     mesh->coarsen(100);            // 100 levels down again
///     draw(mesh->mesh());
///
/// Splits may come from the network: each is checked against the mesh before anything is changed.
/// Not thread-safe; distinct objects are independent. Memory: 24 bytes a face for connectivity, 24 a vertex for positions, 24 a
/// split for undoing.
class ProgressiveMesh {
public:
    /// \return NON_MANIFOLD, OPEN_MESH, INDEX_OUT_OF_RANGE or INVALID_COORDINATE when `base` is no closed 2-manifold.
    /// O(faces log faces).
    [[nodiscard]] static Expected<ProgressiveMesh> from_base(TriangleMesh base);

    /// Applies splits in order; the first is split number level(). On CORRUPT the mesh stands at the level of the splits before
    /// the bad one, whose number the message gives. O(splits * ring).
    [[nodiscard]] Status refine(std::span<const VertexSplit> splits);

    /// Undoes the last `count` splits, at most all. O(count * ring). Needs no records.
    void coarsen(std::size_t count);

    /// Splits applied so far.
    [[nodiscard]] std::size_t level() const { return undo_.size(); }

    /// The mesh at this level. The reference stays valid; its content changes with refine and coarsen.
    [[nodiscard]] const TriangleMesh& mesh() const { return mesh_; }

private:
    ProgressiveMesh() = default;

    [[nodiscard]] Status check(const VertexSplit& split) const;
    void apply(const VertexSplit& split);
    void undo_last();

    TriangleMesh mesh_;
    std::vector<std::uint32_t> twin_;  // of half-edge 3f + c, which leaves corner c of face f along it
    std::vector<Vec3> undo_;           // where the vertex of each applied split lay before
};

/// The mesh of `mrr` at a level (clamped to the last). O(level). \pre `mrr` was made by this library (asserts otherwise).
[[nodiscard]] TriangleMesh mesh_at(const MultiresMesh& mrr, std::size_t level);

}  // namespace vsplit
